/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compliance of a ring of equal sectors by circumferential harmonics. */
#include "ring.h"

#include "condense.h"

#include <complex.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

/* The loads: forces on the flank; forces on the axis of the tooth below them; and at two points of
   the flank a pressure, a force in the middle of the pressure, and a force on the axis below. */
enum {
    ROLLS = STIFFNESS_RING_ROLLS,
    PLACES = 2,
    PRESSURE = 2 * ROLLS,
    LOADS = PRESSURE + 3 * PLACES
};
enum {
    MIDDLE = ROLLS / 2,
    PRESSURE_PARTS = 200,
    PARTS = 2 * ROLLS + PLACES * (PRESSURE_PARTS + 2)
};

/* Positions of the pressures on the flank, from its lowest point (0) to the tip (1), and their half
   width, relative to the depth of the tooth's axis below the flank. */
static const double place[PLACES] = {0.3, 0.7}, width_ratio = 0.3;

/* Chebyshev points including both ends, and their barycentric weights. */
static void place_rolls(stiffness_ring *r)
{
    for (int i = 0; i < ROLLS; i++) {
        double x = cos(M_PI * i / (ROLLS - 1));
        r->roll[i] = r->roll_low + (r->roll_high - r->roll_low) * (1 - x) / 2;
        r->weight[i] = (i % 2 ? -1 : 1) * (i == 0 || i == ROLLS - 1 ? 0.5 : 1);
    }
}

static stiffness_nodal part_of(size_t load, stiffness_nodal part)
{
    part.load = load;
    return part;
}

/* Adds an elliptical pressure as parallel forces at Gauss-Chebyshev points. */
static size_t add_pressure(const stiffness_sector *s, size_t load, double roll,
                           stiffness_nodal *part)
{
    stiffness_flank_force middle = stiffness_contour_force(s->contour, roll);
    for (int k = 0; k < PRESSURE_PARTS; k++) {
        double angle = M_PI * (k + 0.5) / PRESSURE_PARTS;
        double along = width_ratio * middle.depth * cos(angle);
        double share = 2 * sin(angle) * sin(angle) / PRESSURE_PARTS;
        /* ds = r_b roll droll */
        part[k] = stiffness_sector_force(s, roll + along / (s->contour->base_radius * roll));
        part[k].load = load;
        part[k].direction = middle.direction;
        for (int n = 0; n < 3; n++)
            part[k].weight[n] *= share;
    }
    return PRESSURE_PARTS;
}

static double place_roll(const stiffness_ring *r, int p)
{
    return r->roll_low + place[p] * (r->roll_high - r->roll_low);
}

static void make_loads(const stiffness_ring *r, const stiffness_sector *s,
                       stiffness_nodal part[PARTS])
{
    size_t n = 0;
    for (size_t i = 0; i < ROLLS; i++) {
        part[n++] = part_of(i, stiffness_sector_force(s, r->roll[i]));
        part[n++] = part_of(ROLLS + i, stiffness_sector_axis(s, r->roll[i]));
    }
    for (int p = 0; p < PLACES; p++) {
        size_t load = PRESSURE + 3 * (size_t)p;
        n += add_pressure(s, load, place_roll(r, p), part + n);
        part[n++] = part_of(load + 1, stiffness_sector_force(s, place_roll(r, p)));
        part[n++] = part_of(load + 2, stiffness_sector_axis(s, place_roll(r, p)));
    }
}

/* Johnson 1985 eq. 5.57 for an elliptical pressure of half width a and depth h. Plane strain: 2
 * (1 - nu^2)/(pi E b) (ln(2 h/a) - nu/(2 (1 - nu))); plane stress: 2/(pi E b) (ln(2 h/a) -
 * nu/2). */
static double half_plane(const stiffness_material *m)
{
    double e = m->elastic_modulus, nu = m->poisson_ratio;
    if (m->plane_strain) {
        e /= 1 - nu * nu;
        nu /= 1 - nu;
    }
    return 2 / (M_PI * e * m->width) * (log(2 / width_ratio) - nu / 2);
}

/* Computes the approach between flank and axis under the pressures, minus that of a half plane. */
static void add_thinness(stiffness_ring *r, const stiffness_condensed *c,
                         const stiffness_material *material)
{
    for (size_t p = 0; p < PLACES; p++) {
        size_t load = PRESSURE + 3 * p;
        r->thin[p] = c->held[(load + 1) * LOADS + load] - c->held[(load + 2) * LOADS + load] -
                     half_plane(material);
    }
    for (int i = 0; i < ROLLS; i++) {
        double t = (r->roll[i] - place_roll(r, 0)) / (place_roll(r, 1) - place_roll(r, 0));
        r->own[i] += r->thin[0] + t * (r->thin[1] - r->thin[0]);
    }
}

/* Rotate x and y of the nodes on the right side into the frame of the next sector: turn_rows in the
   rows of a matrix with `columns` columns of 2 side numbers, turn_columns in the columns of a
   square matrix. */
static void turn_rows(double *matrix, size_t side, size_t columns, double c, double s)
{
    for (size_t k = 0; k < columns; k++)
        for (size_t i = side; i < 2 * side; i += 2) {
            double *at = matrix + k * 2 * side + i, x = at[0], y = at[1];
            at[0] = c * x + s * y;
            at[1] = c * y - s * x;
        }
}

static void turn_columns(double *matrix, size_t side, double c, double s)
{
    for (size_t k = side; k < 2 * side; k += 2)
        for (size_t i = 0; i < 2 * side; i++) {
            double *x = matrix + k * 2 * side + i, *y = x + 2 * side, kept = *x;
            *x = c * kept + s * *y;
            *y = c * *y - s * kept;
        }
}

typedef struct harmonic {
    size_t side;
    double complex *matrix, *load; /* side x side, side x LOADS */
} harmonic;

/* Harmonic n: the displacement of the right side is z times that of the left side, z = exp(2 pi i
   n/teeth). On return, `load` is L^-1 h, where L L^H is the stiffness matrix of the harmonic and h
   its loads. */
static int solve_harmonic(const stiffness_condensed *c, double complex z, harmonic *h)
{
    size_t n = c->side;
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) {
            const double *left = c->stiffness + j * 2 * n, *right = left + 2 * n * n;
            h->matrix[j * n + i] = left[i] + right[n + i] + z * right[i] + conj(z) * left[n + i];
        }
    for (size_t l = 0; l < LOADS; l++)
        for (size_t i = 0; i < n; i++)
            h->load[l * n + i] = c->pull[l * 2 * n + i] + conj(z) * c->pull[l * 2 * n + n + i];
    lapack_int size = (lapack_int)n;
    if (LAPACKE_zpotrf(LAPACK_COL_MAJOR, 'L', size, h->matrix, size) != 0)
        return 0;
    return LAPACKE_ztrtrs(LAPACK_COL_MAJOR, 'L', 'N', 'N', size, LOADS, h->matrix, size, h->load,
                          size) == 0;
}

static double complex product(const harmonic *h, size_t a, size_t b)
{
    double complex sum = 0;
    for (size_t i = 0; i < h->side; i++)
        sum += conj(h->load[b * h->side + i]) * h->load[a * h->side + i];
    return sum;
}

/* Adds the contribution of the harmonic to all compliances, with the factor `part`: a load on one
   sector contains all harmonics with equal amplitude. */
static void add_harmonic(stiffness_ring *r, const harmonic *h, double complex z, double part)
{
    for (size_t a = 0; a < ROLLS; a++) {
        r->own[a] += part * creal(product(h, a, ROLLS + a));
        for (size_t b = 0; b < ROLLS; b++) {
            double complex p = product(h, a, b), turn = 1;
            for (int d = 0; d <= STIFFNESS_RING_PLACES; d++, turn *= z)
                r->other[d][a][b] += part * creal(turn * p);
        }
    }
}

static int add_harmonics(stiffness_ring *r, stiffness_condensed *c, size_t teeth)
{
    double angle = 2 * M_PI / (double)teeth;
    harmonic h = {.side = c->side};
    h.matrix = malloc(c->side * c->side * sizeof *h.matrix);
    h.load = malloc(c->side * LOADS * sizeof *h.load);
    int result = h.matrix && h.load ? STIFFNESS_RING_MADE : STIFFNESS_RING_MEMORY;
    turn_rows(c->stiffness, c->side, 2 * c->side, cos(angle), sin(angle));
    turn_columns(c->stiffness, c->side, cos(angle), sin(angle));
    turn_rows(c->pull, c->side, LOADS, cos(angle), sin(angle));
    /* harmonics n and teeth - n are complex conjugates */
    for (size_t n = 0; 2 * n <= teeth && result == STIFFNESS_RING_MADE; n++) {
        double complex z = cexp(I * angle * (double)n);
        int single = n == 0 || 2 * n == teeth;
        if (!solve_harmonic(c, z, &h))
            result = STIFFNESS_RING_SINGULAR;
        else
            add_harmonic(r, &h, z, (single ? 1 : 2) / (double)teeth);
        if (n == 0 && result == STIFFNESS_RING_MADE)
            r->turning = (creal(product(&h, MIDDLE, MIDDLE)) + c->held[MIDDLE * LOADS + MIDDLE]) /
                         (double)teeth;
    }
    free(h.matrix);
    free(h.load);
    return result;
}

/* Adds the compliance of a sector with fixed sides, and sets `reciprocity`. */
static void add_held(stiffness_ring *r, const stiffness_condensed *c)
{
    double worst = 0, largest = 0;
    for (size_t a = 0; a < ROLLS; a++) {
        /* displacement of the axis under the force on the flank */
        r->own[a] += c->held[(ROLLS + a) * LOADS + a];
        for (size_t b = 0; b < ROLLS; b++)
            r->other[0][a][b] += c->held[b * LOADS + a];
    }
    for (size_t a = 0; a < ROLLS; a++)
        for (size_t b = 0; b < ROLLS; b++) {
            worst = fmax(worst, fabs(r->other[0][a][b] - r->other[0][b][a]));
            largest = fmax(largest, fabs(r->other[0][a][b]));
        }
    r->reciprocity = worst / largest;
}

int stiffness_ring_make(stiffness_ring *ring, const stiffness_contour *contour, double rim_radius,
                        const stiffness_material *material, size_t elements)
{
    stiffness_sector sector;
    stiffness_condensed condensed = {0};
    stiffness_nodal *part = malloc(PARTS * sizeof *part);
    *ring = (stiffness_ring){.roll_low = contour->form_roll, .roll_high = contour->tip_roll};
    place_rolls(ring);
    int result = STIFFNESS_RING_MEMORY;
    if (!stiffness_sector_make(&sector, contour, rim_radius, elements) || !part)
        goto out;
    ring->nodes = sector.nodes;
    ring->elements = sector.elements;
    make_loads(ring, &sector, part);
    result = stiffness_condense(&condensed, &sector, material, LOADS, PARTS, part);
    if (result == STIFFNESS_CONDENSED)
        result = add_harmonics(ring, &condensed, (size_t)lround(M_PI / contour->half_sector));
    else
        result =
            result == STIFFNESS_CONDENSE_MEMORY ? STIFFNESS_RING_MEMORY : STIFFNESS_RING_SINGULAR;
    if (result == STIFFNESS_RING_MADE) {
        add_held(ring, &condensed);
        add_thinness(ring, &condensed, material);
    }
out:
    free(part);
    stiffness_condensed_free(&condensed);
    stiffness_sector_free(&sector);
    return result;
}

/* Roll angles that differ by less than this, in rad, are treated as equal. */
static const double same_roll = 1e-12;

/* Barycentric interpolation (Berrut & Trefethen 2004): computes the weights of the points for the
   value at `roll`. */
static void shares(const stiffness_ring *r, double roll, double share[ROLLS])
{
    double sum = 0;
    for (int i = 0; i < ROLLS; i++) {
        double distance = roll - r->roll[i];
        if (fabs(distance) < same_roll) {
            for (int k = 0; k < ROLLS; k++)
                share[k] = k == i;
            return;
        }
        share[i] = r->weight[i] / distance;
        sum += share[i];
    }
    for (int i = 0; i < ROLLS; i++)
        share[i] /= sum;
}

double stiffness_ring_own(const stiffness_ring *ring, double roll)
{
    double share[ROLLS], value = 0;
    shares(ring, roll, share);
    for (int i = 0; i < ROLLS; i++)
        value += share[i] * ring->own[i];
    return value;
}

double stiffness_ring_other(const stiffness_ring *ring, int places, double load, double at)
{
    double from[ROLLS], to[ROLLS], value = 0;
    int forward = places > 0, d = abs(places);
    if (d > STIFFNESS_RING_PLACES)
        return 0;
    shares(ring, forward ? load : at, from);
    shares(ring, forward ? at : load, to);
    for (int a = 0; a < ROLLS; a++)
        for (int b = 0; b < ROLLS; b++)
            value += from[a] * to[b] * ring->other[d][a][b];
    return value;
}
