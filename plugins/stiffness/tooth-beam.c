/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compliance of a tooth by the potential-energy method. */
#include "tooth-beam.h"

#include "../numerics/involute.h"

#include <math.h>

/* Shear correction factor of a rectangular section. */
static const double shear_factor = 1.2;

double stiffness_compliance_sum(const stiffness_compliance *c)
{
    return c->bending + c->shear + c->axial + c->foundation;
}

/* Tian 2004, with M = cos(a) (x_c - x) - sin(a) y_c, I = 2/3 y^3 b, A = 2 y b: bending M^2/(E
 * I), shear 1.2 cos^2(a)/(G A), axial sin^2(a)/(E A). */
void stiffness_beam_density(const stiffness_beam *beam, const stiffness_section *at,
                            const stiffness_load *load, double density[3])
{
    double c = load->across, s = load->along;
    double moment = c * (load->x - at->x) - s * load->y;
    double inertia = 2.0 / 3.0 * at->half * at->half * at->half * beam->width;
    double area = 2 * at->half * beam->width;
    density[0] = moment * moment / (beam->bending * inertia) * at->dx;
    density[1] = shear_factor * c * c / (beam->shear * area) * at->dx;
    density[2] = s * s / (beam->axial * area) * at->dx;
}

void stiffness_beam_add(const stiffness_beam *beam, stiffness_outline outline, const void *shape,
                        double t0, double t1, const stiffness_load *load,
                        const gsl_integration_glfixed_table *rule, stiffness_compliance *c)
{
    for (size_t i = 0; i < rule->n; i++) {
        double t, weight, density[3];
        gsl_integration_glfixed_point(t0, t1, i, &t, &weight, rule);
        stiffness_section at = outline(shape, t);
        stiffness_beam_density(beam, &at, load, density);
        c->bending += weight * density[0];
        c->shear += weight * density[1];
        c->axial += weight * density[2];
    }
}

/* Polynomial and coefficients of Sainsot et al. 2004: A/theta^2 + B h^2 + C h/theta + D/theta +
 * E h + F. */
stiffness_sainsot stiffness_sainsot_at(double h, double theta)
{
    static const double table[4][6] = {
        {-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045},
        {60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086},
        {-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236},
        {-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904},
    };
    double value[4];
    for (int i = 0; i < 4; i++) {
        const double *k = table[i];
        value[i] = k[0] / (theta * theta) + k[1] * h * h + k[2] * h / theta + k[3] / theta +
                   k[4] * h + k[5];
    }
    return (stiffness_sainsot){value[0], value[1], value[2], value[3]};
}

void stiffness_tooth_make(stiffness_tooth *tooth, const stiffness_tooth_data *d)
{
    /* roll angles tan(a) at the reference and at the root circle */
    double reference = d->reference_radius / d->base_radius;
    double roll = sqrt(reference * reference - 1);
    double ratio = fmax(d->root_radius / d->base_radius, 1);
    double root_roll = sqrt(ratio * ratio - 1);
    double half_angle = d->thickness / (2 * d->reference_radius) + roll - atan(roll);
    double root_half_angle = half_angle - numerics_involute_at_roll(root_roll);
    double plane = d->plane_strain ? 1 - d->poisson_ratio * d->poisson_ratio : 1;
    *tooth = (stiffness_tooth){
        .base_radius = d->base_radius,
        .root_radius = d->root_radius,
        .half_angle = half_angle,
        .root_roll = root_roll,
        .root_half_angle = root_half_angle,
        .body_ratio = d->root_radius / d->rim_radius,
        .elastic_modulus = d->elastic_modulus,
        .width = d->width,
        .beam = {.bending = d->elastic_modulus / plane,
                 .axial = d->elastic_modulus / plane,
                 .shear = d->elastic_modulus / (2 * (1 + d->poisson_ratio)),
                 .width = d->width},
        .body = stiffness_sainsot_at(d->root_radius / d->rim_radius, root_half_angle),
    };
}

void stiffness_tooth_of_gear(stiffness_tooth *tooth, const stiffness_gears *gears, int gear,
                             bool plane_strain)
{
    const stiffness_gear *g = &gears->gear[gear];
    stiffness_tooth_data data = {.base_radius = g->base_radius,
                                 .root_radius = g->root_radius,
                                 .reference_radius = g->reference_radius,
                                 .rim_radius = g->rim_radius,
                                 .thickness = g->thickness,
                                 .width = gears->width,
                                 .elastic_modulus = g->elastic_modulus,
                                 .poisson_ratio = g->poisson_ratio,
                                 .plane_strain = plane_strain};
    stiffness_tooth_make(tooth, &data);
}

/* The normal of the flank at roll angle t touches the base circle, at the angle psi = t -
 * half_angle to the normal of the tooth's axis. */
stiffness_section stiffness_tooth_involute(const void *shape, double roll)
{
    const stiffness_tooth *tooth = shape;
    double psi = roll - tooth->half_angle, r = tooth->base_radius;
    double c = cos(psi), s = sin(psi);
    return (stiffness_section){r * (c + roll * s), r * (roll * c - s), r * roll * c};
}

stiffness_section stiffness_tooth_radial(const void *shape, double radius)
{
    const stiffness_tooth *tooth = shape;
    double c = cos(tooth->half_angle), s = sin(tooth->half_angle);
    return (stiffness_section){radius * c, radius * s, c};
}

stiffness_load stiffness_tooth_load(const stiffness_tooth *tooth, double roll)
{
    stiffness_section at = stiffness_tooth_involute(tooth, roll);
    double angle = roll - tooth->half_angle;
    return (stiffness_load){at.x, at.half, cos(angle), sin(angle)};
}

/* Sainsot et al. 2004: cos^2(a)/(b E) {L (u/S)^2 + M u/S + P (1 + Q tan^2(a))}. The line of
 * force crosses the tooth's axis at r_b/cos(a), u above the root circle; S is the arc of the
 * tooth at the root. */
static double foundation(const stiffness_tooth *tooth, const stiffness_load *load)
{
    double c = load->across, tangent = load->along / c;
    double u = tooth->base_radius / c - tooth->root_radius;
    double q = u / (2 * tooth->root_radius * tooth->root_half_angle);
    const stiffness_sainsot *b = &tooth->body;
    return c * c / (tooth->width * tooth->elastic_modulus) *
           ((b->L * q + b->M) * q + b->P * (1 + b->Q * tangent * tangent));
}

stiffness_compliance stiffness_tooth_compliance(const stiffness_tooth *tooth, double roll,
                                                const gsl_integration_glfixed_table *rule)
{
    stiffness_load load = stiffness_tooth_load(tooth, roll);
    stiffness_compliance c = {.foundation = foundation(tooth, &load)};
    if (tooth->root_radius < tooth->base_radius)
        stiffness_beam_add(&tooth->beam, stiffness_tooth_radial, tooth, tooth->root_radius,
                           tooth->base_radius, &load, rule, &c);
    stiffness_beam_add(&tooth->beam, stiffness_tooth_involute, tooth, tooth->root_roll, roll, &load,
                       rule, &c);
    return c;
}
