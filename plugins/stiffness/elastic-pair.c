/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compliance of a pair of gears with elastic teeth. */
#include "elastic-pair.h"

#include "contact-point.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Above this Poisson's ratio, displacement elements lock in plane strain. */
static const double nearly_incompressible = 0.49;

/* Weber 1949, Johnson 1985 eq. 5.57: approach between the surface and a point at depth h below
 * the middle of a Hertzian line contact, 2 f (1 - nu^2)/(pi E b) (ln(2 h/a) - nu/(2 (1 - nu))),
 * summed over both teeth; a^2 = 4 f R/(pi E* b). In plane stress, E replaces E/(1 - nu^2) and nu
 * replaces nu/(1 - nu). */
stiffness_hertz stiffness_elastic_pair_approach(const stiffness_elastic_pair *p,
                                                const double roll[2], double curvature, bool strain)
{
    stiffness_hertz h = {0};
    double half_space[2], ratio[2]; /* the sum of half_space is 1/(pi E* b) */
    for (int g = 0; g < 2; g++) {
        double nu = p->gears->gear[g].poisson_ratio;
        half_space[g] = p->half_space[g] / (strain ? 1 : 1 - nu * nu);
        ratio[g] = strain ? nu / (1 - nu) : nu;
    }
    for (int g = 0; g < 2; g++) {
        double depth = stiffness_contour_force(&p->body[g]->contour, roll[g]).depth;
        h.constant +=
            half_space[g] *
            (2 * log(2 * depth) - log(4 * curvature * (half_space[0] + half_space[1])) - ratio[g]);
        h.slope += half_space[g];
    }
    return h;
}

double stiffness_elastic_pair_teeth(const stiffness_elastic_pair *p, const double roll[2])
{
    double sum = 0;
    for (int g = 0; g < 2; g++) {
        if (p->model->compliance == STIFFNESS_ANALYTICAL) {
            stiffness_compliance c =
                stiffness_tooth_compliance(&p->tooth[g], roll[g], p->model->rule);
            sum += stiffness_compliance_sum(&c);
        } else
            sum += stiffness_ring_own(&p->body[g]->ring, roll[g]);
    }
    return sum;
}

/* Returns the displacement of pair i under a unit force on pair k. Older pairs are ahead in the
   direction of rotation: on the driving gear on the side of the loaded flank, on the driven gear on
   the other side. */
static double cross_compliance(const stiffness_elastic_pair *p, const stiffness_position *at,
                               size_t i, size_t k)
{
    int ahead = (int)lround(at->age[i] - at->age[k]);
    if (p->model->compliance == STIFFNESS_ANALYTICAL || !p->model->coupling)
        return 0;
    return stiffness_ring_other(&p->body[0]->ring, ahead, at->roll[k][0], at->roll[i][0]) +
           stiffness_ring_other(&p->body[1]->ring, -ahead, at->roll[k][1], at->roll[i][1]);
}

void stiffness_elastic_pair_compliance(const void *self, const stiffness_position *at,
                                       stiffness_contacts *c)
{
    const stiffness_elastic_pair *p = self;
    for (size_t i = 0; i < at->count; i++) {
        c->compliance[i][i] = stiffness_elastic_pair_teeth(p, at->roll[i]);
        /* the contact is narrow compared with the face width, so it is in plane strain even if the
           tooth is in plane stress */
        c->hertz[i] = stiffness_elastic_pair_approach(
            p, at->roll[i], stiffness_gears_curvature(p->gears, at->age[i]), true);
        for (size_t k = 0; k < i; k++)
            c->compliance[i][k] = c->compliance[k][i] = cross_compliance(p, at, i, k);
    }
}

static stiffness_body_data data_of(const stiffness_elasticity *m, const stiffness_gears *gears,
                                   int gear)
{
    const stiffness_gear *g = &gears->gear[gear];
    stiffness_body_data r;
    memset(&r, 0, sizeof r);
    r.contour = (stiffness_contour_data){.teeth = g->teeth,
                                         .base_radius = g->base_radius,
                                         .reference_radius = g->reference_radius,
                                         .root_radius = g->root_radius,
                                         .tip_roll = g->roll_tip,
                                         .thickness = g->thickness,
                                         .contact_roll = g->roll_low,
                                         .round = g->tool_tip * 2 * g->reference_radius / g->teeth};
    r.material.elastic_modulus = g->elastic_modulus;
    r.material.poisson_ratio = g->poisson_ratio;
    r.material.width = gears->width;
    r.material.plane_strain = m->plane == STIFFNESS_STRAIN;
    r.rim_radius = g->rim_radius;
    r.elements = (size_t)m->elements;
    return r;
}

static ff_status fail_ring(const stiffness_elasticity *m, int gear, int result)
{
    if (result == STIFFNESS_RING_MEMORY)
        return ff_failf(m->host, FF_NOMEM, "elements_per_tooth", "out of memory");
    return ff_failf(m->host, FF_NOCONV, "elements_per_tooth",
                    "gear %d: the stiffness matrix of the elements is singular", gear + 1);
}

/* Computes the ring of a gear, and estimates its error from a mesh with half as many elements; the
   error decreases at least in proportion to the number of elements. */
static ff_status make_ring(const stiffness_elasticity *m, int gear, stiffness_body *b)
{
    const stiffness_body_data *r = &b->data;
    stiffness_ring *coarse = malloc(sizeof *coarse);
    if (!coarse)
        return FF_NOMEM;
    int result =
        stiffness_ring_make(&b->ring, &b->contour, r->rim_radius, &r->material, r->elements);
    if (result == STIFFNESS_RING_MADE)
        result =
            stiffness_ring_make(coarse, &b->contour, r->rim_radius, &r->material, r->elements / 2);
    if (result == STIFFNESS_RING_MADE) {
        double roll = (b->ring.roll_low + b->ring.roll_high) / 2;
        b->mesh_error =
            fabs(stiffness_ring_own(coarse, roll) / stiffness_ring_own(&b->ring, roll) - 1);
    }
    free(coarse);
    return result == STIFFNESS_RING_MADE ? FF_OK : fail_ring(m, gear, result);
}

static ff_status make_body(const stiffness_elasticity *m, const stiffness_gears *gears, int gear,
                           stiffness_body *b)
{
    stiffness_body_data wanted = data_of(m, gears, gear);
    if (b->made && !memcmp(&b->data, &wanted, sizeof wanted))
        return FF_OK;
    b->made = false;
    b->data = wanted;
    const char *why = stiffness_contour_make(&b->contour, &wanted.contour);
    if (why)
        return ff_failf(m->host, FF_INVALID, "gear.root_radius", "gear %d: %s", gear + 1, why);
    if (wanted.material.plane_strain && !(wanted.material.poisson_ratio < nearly_incompressible))
        return ff_failf(m->host, FF_INVALID, "plane",
                        "gear %d: these elements do not support plane strain of a material with "
                        "Poisson's ratio %g; use plane stress",
                        gear + 1, wanted.material.poisson_ratio);
    if (m->compliance != STIFFNESS_ANALYTICAL) {
        ff_status status = make_ring(m, gear, b);
        if (status != FF_OK)
            return status;
    }
    b->made = m->compliance != STIFFNESS_ANALYTICAL;
    return FF_OK;
}

ff_status stiffness_elastic_pair_make(stiffness_elasticity *m, const stiffness_gears *gears,
                                      stiffness_elastic_pair *p)
{
    *p = (stiffness_elastic_pair){.model = m, .gears = gears};
    for (int g = 0; g < 2; g++) {
        if (m->host->progress(m->host->ctx, 0.4 * g) != 0)
            return FF_STOPPED;
        const stiffness_gear *gear = &gears->gear[g];
        stiffness_body_data wanted = data_of(m, gears, g);
        bool twin = g == 1 && m->body[0].made && !memcmp(&m->body[0].data, &wanted, sizeof wanted);
        ff_status status = twin ? FF_OK : make_body(m, gears, g, &m->body[g]);
        if (status != FF_OK)
            return status;
        p->body[g] = &m->body[twin ? 0 : g];
        stiffness_tooth_of_gear(&p->tooth[g], gears, g, m->plane == STIFFNESS_STRAIN);
        p->half_space[g] = (1 - gear->poisson_ratio * gear->poisson_ratio) /
                           (M_PI * gear->elastic_modulus * gears->width);
    }
    return FF_OK;
}
