/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "local.h"

#include "../../numerics/bracket.h"

#include <math.h>

enum { N = EHL_LOCAL_POINTS, MOST_ROUNDS = 100 };

double ehl_local_place(int part)
{
    return -cos(M_PI * (part + 0.5) / N);
}

/* Data of a function of one unknown. */
typedef struct scene {
    const ehl_local *l;
    const ehl_local_contact *c;
    double p[N], h[N];
    ehl_local_friction f;
} scene;

/* Returns the root of an increasing function between a and b, where its signs differ, with the
   accuracy `within`. */
static double root_of(double (*f)(scene *, double), scene *s, double a, double b, double within)
{
    numerics_bracket r = {a, f(s, a), b, f(s, b), 0};
    if (!(r.f_low < 0))
        return a;
    for (int k = 0; k < MOST_ROUNDS && r.high - r.low > within && r.f_high > 0; k++) {
        double x = numerics_bracket_secant(&r);
        x = fmin(fmax(x, r.low + within / 2), r.high - within / 2);
        numerics_bracket_narrow(&r, x, f(s, x));
    }
    return r.high;
}

/* Returns the share of the load on asperities, at most 1, if the distance of the mean planes is
   `apart`, which is negative if the planes cross. */
static double carried_at(scene *s, double apart)
{
    const ff_asperity *law = s->l->asperities;
    double p_a = 0, mean = s->c->load / (2 * s->c->a);
    s->f.closure = law->pressure(law->self, 1, &apart, &p_a, NULL);
    p_a *= s->l->modulus / law->modulus;
    if (s->l->hardness > 0)
        p_a /= 1 + p_a / s->l->hardness;
    return fmin(p_a / mean, 1);
}

/* Returns g (1 - s)^0.13 - c->h, where g is the mean gap and s the share of the load on asperities
   if the mean planes of the flanks have the distance H sigma. The result is 0 if the mean gap
   equals the film h (1 - s)^-0.13 that the oil forms under its share 1 - s of the load (Johnson,
   Greenwood & Poon 1972, with the exponent of the load in Dowson & Higginson's film). The mean gap
   of Gaussian heights, cut off where they would cross, is g = sigma (H Phi(H) + phi(H)) (Patir &
   Cheng 1978). Flanks without an oil film approach until the asperities carry the load. */
static double unbalanced(scene *s, double H)
{
    const double sigma = s->l->asperities->sigma;
    double below = 0.5 * erfc(-H / sqrt(2)), density = exp(-H * H / 2) / sqrt(2 * M_PI);
    double gap = fmax(H * below + density, 0) * sigma;
    return gap * pow(1 - carried_at(s, H * sigma), 0.13) - s->c->h;
}

/* Returns the share by Masjedi & Khonsari 2012, J. Tribol. 134, 011503, for line contacts. */
static double masjedi_khonsari(const ehl_local *l, const ehl_local_contact *c, ff_status *closure)
{
    const double roughest = 5e-5; /* largest sigma/R of their films */
    double size = l->modulus * c->radius, s = l->asperities->sigma / c->radius;
    *closure = s > roughest ? FF_DOMAIN : FF_OK;
    double U = l->viscosity * c->entrainment / size, W = c->load / size, G = l->alpha * l->modulus;
    /* without a hardness, the value of case-hardened steel is used, 7 GPa over 230 GPa */
    double V = l->hardness > 0 ? l->hardness / l->modulus : 0.03;
    double ln = 6.015 * log(s) + 1.168 * log(V) + 0.485 * log(W) - 3.741 * log(U) - 2.898 * log(G);
    double log_term = ln > 600 ? log(4470) + ln : log1p(4470 * exp(ln));
    double percent = 0.005 * pow(W, -0.408) * pow(U, -0.088) * pow(G, 0.103) * log_term;
    return fmin(fmax(percent / 100, 0), 1);
}

/* Returns the share of the load on asperities if the film is c->h. */
static double share_of(const ehl_local *l, const ehl_local_contact *c, ff_status *closure)
{
    *closure = FF_OK;
    scene s = {.l = l, .c = c};
    if (!l->asperities || !(c->load > 0))
        return 0;
    if (l->share == EHL_MASJEDI_KHONSARI)
        return masjedi_khonsari(l, c, closure);
    if (l->share == EHL_CLARKE) /* Clarke et al. 2015, Tribol. Int. 90 */
        return erfc(c->h / l->asperities->sigma);
    /* at a distance of `far` times sigma asperities are not in contact */
    const double far = 8, sigma = l->asperities->sigma;
    double H = root_of(unbalanced, &s, -far, c->h / sigma + far, 1e-9);
    double share = carried_at(&s, H * sigma);
    *closure = s.f.closure;
    return share;
}

/* Computes the friction at the temperature T from the oil's share of p. If T is NaN, the laws
   use their reference temperature. */
static void rub(scene *s, double T)
{
    const ehl_laws *laws = s->l->laws;
    double at[N], ln_eta[N], tau[N], sum = 0;
    for (int i = 0; i < N; i++)
        at[i] = T;
    s->f.laws =
        ehl_fluid_shear(laws, N, s->p, isnan(T) ? NULL : at, s->h, s->c->sliding, ln_eta, tau);
    for (int i = 0; i < N; i++)
        sum += tau[i] * sin(M_PI * (i + 0.5) / N);
    s->f.oil = sum * M_PI / N * s->c->a;
}

/* Returns T minus the temperature caused by the friction at T. */
static double too_warm(scene *s, double T)
{
    const ehl_local *l = s->l;
    const ehl_local_contact *c = s->c;
    double u_1 = c->entrainment + c->sliding / 2, u_2 = c->entrainment - c->sliding / 2;
    rub(s, T);
    double width = 2 * c->a, oil = fabs(s->f.oil) / width * fabs(c->sliding);
    double all = oil + fabs(s->f.asperities) / width * fabs(c->sliding);
    double p = (1 - s->f.share) * c->load / width;
    double conductivity = l->conductivity * (1 + l->conducts.rise * p / (1 + l->conducts.bend * p));
    double taken = l->contact[0] * sqrt(fabs(u_1)) + l->contact[1] * sqrt(fabs(u_2));
    s->f.rise = 0.752 * all * sqrt(width) / taken + c->h * oil / (8 * conductivity);
    return T - l->bulk - s->f.rise;
}

ehl_local_friction ehl_local_evaluate(const ehl_local *l, const ehl_local_contact *c,
                                      const double *h)
{
    const double within = 1e-4; /* tolerance, K */
    scene s = {.l = l, .c = c};
    s.f.share = share_of(l, c, &s.f.closure);
    s.f.asperities = copysign(l->boundary_friction * s.f.share * c->load, c->sliding);
    if (!(fabs(c->sliding) > 0))
        s.f.asperities = 0;
    for (int i = 0; i < N; i++) {
        double x = ehl_local_place(i);
        s.p[i] = (1 - s.f.share) * c->p_max * sqrt((1 - x) * (1 + x));
        s.h[i] = h ? h[i] : c->h;
    }
    if (!(l->bulk > 0) || !(fabs(c->sliding) > 0)) {
        rub(&s, l->bulk > 0 ? l->bulk : NAN);
        return s.f;
    }
    double cold = too_warm(&s, l->bulk);
    too_warm(&s, root_of(too_warm, &s, l->bulk, l->bulk - cold, within));
    return s.f;
}
