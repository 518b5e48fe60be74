/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outline, finite elements and compliance of a gear. */
#include "../../../plugins/stiffness/elements/ring.h"
#include "../../../plugins/stiffness/elements/condense.h"

#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <suitesparse/cholmod.h>

static const stiffness_material steel = {206e9, 0.3, 0.02, 1};

/* Returns data of 20 deg teeth, module 3, with contact from the lowest point that an equal gear
   reaches. */
static stiffness_contour_data tooth(double teeth, double dedendum)
{
    double r = 1.5e-3 * teeth, base = r * cos(M_PI / 9), tip = sqrt(pow((r + 3e-3) / base, 2) - 1);
    return (stiffness_contour_data){.teeth = teeth,
                                    .base_radius = base,
                                    .reference_radius = r,
                                    .root_radius = r - 3e-3 * dedendum,
                                    .tip_roll = tip,
                                    .thickness = 1.5e-3 * M_PI,
                                    .contact_roll = 2 * tan(M_PI / 9) - tip,
                                    .round = 0.38 * 3e-3};
}

static stiffness_contour contour(double teeth, double dedendum)
{
    stiffness_contour_data data = tooth(teeth, dedendum);
    stiffness_contour c;
    check_true("there is such a tooth", stiffness_contour_make(&c, &data) == NULL);
    return c;
}

static void test_contour(void)
{
    stiffness_contour c = contour(50, 1.25);
    double eps = 1e-7;
    stiffness_point root = stiffness_contour_at(&c, 1), tip = stiffness_contour_at(&c, 3);
    check_near("root circle", hypot(root.x, root.y), 75e-3 - 3.75e-3, 1e-12);
    check_near("tip circle", hypot(tip.x, tip.y), 78e-3, 1e-12);
    stiffness_point a = stiffness_contour_at(&c, 2 - eps), b = stiffness_contour_at(&c, 2),
                    d = stiffness_contour_at(&c, 2 + eps);
    double before = atan2(b.y - a.y, b.x - a.x), after = atan2(d.y - b.y, d.x - b.x);
    check_near("fillet and involute meet", hypot(a.x - d.x, a.y - d.y) + 1, 1, 1e-8);
    check_near("and are tangent", before, after, 1e-5);
    /* a rack of dedendum 1.25 m with tips of 0.38 m is straight down to 1.00 m */
    check_near("form circle", c.form_roll,
               (75e-3 * sin(M_PI / 9) - 3e-3 / sin(M_PI / 9)) / c.base_radius, 2e-3);
}

static void test_undercut_fillet(void)
{
    stiffness_contour_data data = tooth(17, 1.25);
    data.contact_roll = 0.1;
    stiffness_contour c;
    check_true("a little undercut is dealt with", stiffness_contour_make(&c, &data) == NULL);
    stiffness_point a = stiffness_contour_at(&c, 2), b = stiffness_contour_at(&c, 2 + 1e-9);
    check_below("no gap", hypot(a.x - b.x, a.y - b.y), 1e-10);
    check_true("above the base circle", c.form_roll > 0 && c.form_roll < 0.1);
}

static void test_contours_that_do_not_exist(void)
{
    stiffness_contour c;
    stiffness_contour_data data = tooth(50, 2.4);
    check_true("pointed space", stiffness_contour_make(&c, &data) != NULL);
    data = tooth(50, 0.85);
    check_true("contact in the fillet", stiffness_contour_make(&c, &data) != NULL);
    data = tooth(50, 1.25);
    data.tip_roll = 1;
    check_true("pointed tooth", stiffness_contour_make(&c, &data) != NULL);
}

/* With the largest possible fillet radius, the involute must begin at the lowest point of
   contact. */
static void test_largest_fillet(void)
{
    for (double teeth = 24; teeth <= 60; teeth += 4) {
        stiffness_contour_data data = tooth(teeth, 1.25);
        data.round = 0.2 * 3e-3;
        data.contact_roll = 0.3;
        stiffness_contour small, largest;
        check_true("there is such a tooth", stiffness_contour_make(&small, &data) == NULL);
        data.round = 3e-3;
        data.contact_roll = small.form_roll;
        check_true("and one that asks for more", stiffness_contour_make(&largest, &data) == NULL);
        check_near("the same radius", largest.round, small.round, 1e-9);
    }
}

/* Returns the strain energy of u = (a x + b y, c x + d y) in the sector. */
static double energy(const stiffness_sector *s, const stiffness_material *m, const double g[4])
{
    double sum = 0, k[16][16];
    for (size_t e = 0; e < s->elements; e++) {
        double u[16];
        for (size_t n = 0; n < 8; n++) {
            stiffness_point at = s->node[s->element[e][n]];
            u[2 * n] = g[0] * at.x + g[1] * at.y;
            u[2 * n + 1] = g[2] * at.x + g[3] * at.y;
        }
        stiffness_sector_stiffness(s, e, m, k);
        for (size_t i = 0; i < 16; i++)
            for (size_t j = 0; j < 16; j++)
                sum += u[i] * k[i][j] * u[j] / 2;
    }
    return sum;
}

/* Returns the area between rim and outline by an integral along the boundary. */
static double area(const stiffness_contour *c, double rim)
{
    enum { STEPS = 20000 };
    double sum = 0;
    stiffness_point last = stiffness_contour_at(c, 0);
    for (int i = 1; i <= STEPS; i++) {
        stiffness_point at = stiffness_contour_at(c, 3.0 * i / STEPS);
        sum += last.x * at.y - last.y * at.x;
        last = at;
    }
    double half = atan2(last.y, last.x);
    return -sum + c->tip_radius * c->tip_radius * half - rim * rim * c->half_sector;
}

static void test_patch(void)
{
    stiffness_contour c = contour(30, 1.25);
    stiffness_sector s;
    check_true("made", stiffness_sector_make(&s, &c, 25e-3, 400));
    const double turn[4] = {0, -1e-3, 1e-3, 0}, stretch[4] = {1e-3, 0, 0, 0},
                 shear[4] = {0, 5e-4, 5e-4, 0};
    double a = area(&c, 25e-3) * steel.width;
    double e = steel.elastic_modulus, nu = steel.poisson_ratio;
    check_below("a rotation costs nothing", fabs(energy(&s, &steel, turn)), 1e-10);
    check_near("stretch in plane strain", energy(&s, &steel, stretch),
               0.5e-6 * a * e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), 1e-5);
    check_near("shear", energy(&s, &steel, shear), 0.5e-6 * a * e / (2 * (1 + nu)), 1e-5);
    stiffness_material stress = steel;
    stress.plane_strain = 0;
    check_near("stretch in plane stress", energy(&s, &stress, stretch),
               0.5e-6 * a * e / (1 - nu * nu), 1e-5);
    stiffness_sector_free(&s);
}

/* The stiffness matrix of the whole ring of elements. */
typedef struct ring_system {
    const stiffness_sector *sector;
    size_t teeth, nodes; /* nodes of one sector without its left side */
    size_t *number;      /* number of a node of a sector; nodes of its left side belong to the
                            sector before */
    int *left;
} ring_system;

static size_t freedom(const ring_system *r, size_t sector, size_t node)
{
    size_t s = r->left[node] ? (sector + r->teeth - 1) % r->teeth : sector;
    return 2 * (s * r->nodes + r->number[node]);
}

static void number_ring(ring_system *r)
{
    const stiffness_sector *s = r->sector;
    r->number = calloc(s->nodes, sizeof *r->number);
    r->left = calloc(s->nodes, sizeof *r->left);
    for (size_t i = 0; i < s->rows; i++)
        for (size_t j = 1; j < s->columns; j++)
            if (s->grid[i * s->columns + j] != STIFFNESS_NO_NODE)
                r->number[s->grid[i * s->columns + j]] = r->nodes++;
    for (size_t i = 0; i < s->body_rows; i++) {
        size_t left = s->grid[i * s->columns], right = s->grid[(i + 1) * s->columns - 1];
        r->left[left] = 1;
        r->number[left] = r->number[right];
    }
}

static void add_ring_element(const ring_system *r, const stiffness_sector *turned, size_t sector,
                             size_t e, cholmod_triplet *t)
{
    double k[16][16];
    stiffness_sector_stiffness(turned, e, &steel, k);
    for (size_t a = 0; a < 16; a++)
        for (size_t b = 0; b < 16; b++) {
            size_t row = freedom(r, sector, turned->element[e][a / 2]) + a % 2;
            size_t column = freedom(r, sector, turned->element[e][b / 2]) + b % 2;
            if (row < column)
                continue;
            ((int *)t->i)[t->nnz] = (int)row;
            ((int *)t->j)[t->nnz] = (int)column;
            ((double *)t->x)[t->nnz++] = k[a][b];
        }
}

static void hold_rim(const ring_system *r, size_t sector, cholmod_triplet *t)
{
    for (size_t j = 0; j < r->sector->columns; j++)
        for (size_t c = 0; c < 2; c++) {
            int at = (int)(freedom(r, sector, r->sector->grid[j]) + c);
            ((int *)t->i)[t->nnz] = ((int *)t->j)[t->nnz] = at;
            ((double *)t->x)[t->nnz++] = 1e18;
        }
}

static stiffness_point rotate(stiffness_point p, double angle)
{
    return (stiffness_point){p.x * cos(angle) - p.y * sin(angle),
                             p.x * sin(angle) + p.y * cos(angle)};
}

/* Adds a flank force of a sector, or, with `from`, returns the displacement in its direction. */
static double apply(const ring_system *r, size_t sector, const stiffness_nodal *f, double *to,
                    const double *from)
{
    double sum = 0;
    stiffness_point d = rotate(f->direction, 2 * M_PI * (double)sector / (double)r->teeth);
    for (int k = 0; k < 3; k++) {
        size_t at = freedom(r, sector, f->node[k]);
        if (from)
            sum += f->weight[k] * (d.x * from[at] + d.y * from[at + 1]);
        else {
            to[at] += f->weight[k] * d.x;
            to[at + 1] += f->weight[k] * d.y;
        }
    }
    return sum;
}

static void compare_with_ring(const ring_system *r, const stiffness_ring *ring, cholmod_dense *x)
{
    stiffness_nodal near = stiffness_sector_force(r->sector, ring->roll[4]);
    for (int d = 1; d <= 3; d++) {
        size_t ahead = (size_t)d, behind = r->teeth - (size_t)d;
        check_near("tooth ahead", stiffness_ring_other(ring, d, ring->roll[9], ring->roll[4]),
                   apply(r, ahead, &near, NULL, x->x), 1e-8);
        check_near("tooth behind", stiffness_ring_other(ring, -d, ring->roll[9], ring->roll[4]),
                   apply(r, behind, &near, NULL, x->x), 1e-8);
    }
    check_near("same tooth", ring->other[0][9][4], apply(r, 0, &near, NULL, x->x), 1e-8);
}

/* Compares the compliance from harmonics of the sectors with that of the assembled ring. */
static void test_twin_of_the_whole_ring(void)
{
    stiffness_contour c = contour(24, 1.25);
    stiffness_ring *ring = malloc(sizeof *ring);
    stiffness_sector sector, turned;
    check_true("ring", stiffness_ring_make(ring, &c, 20e-3, &steel, 60) == STIFFNESS_RING_MADE);
    check_true("sectors", stiffness_sector_make(&sector, &c, 20e-3, 60) &&
                              stiffness_sector_make(&turned, &c, 20e-3, 60));
    ring_system r = {.sector = &sector, .teeth = 24};
    number_ring(&r);
    cholmod_common common;
    cholmod_start(&common);
    size_t size = 2 * r.nodes * r.teeth;
    cholmod_triplet *t =
        cholmod_allocate_triplet(size, size, r.teeth * (256 * sector.elements + 2 * sector.columns),
                                 -1, CHOLMOD_REAL, &common);
    cholmod_dense *b = cholmod_zeros(size, 1, CHOLMOD_REAL, &common);
    for (size_t s = 0; s < r.teeth; s++) {
        for (size_t n = 0; n < sector.nodes; n++)
            turned.node[n] = rotate(sector.node[n], 2 * M_PI * (double)s / (double)r.teeth);
        for (size_t e = 0; e < sector.elements; e++)
            add_ring_element(&r, &turned, s, e, t);
        hold_rim(&r, s, t);
    }
    cholmod_sparse *matrix = cholmod_triplet_to_sparse(t, t->nnz, &common);
    cholmod_factor *factor = cholmod_analyze(matrix, &common);
    cholmod_factorize(matrix, factor, &common);
    stiffness_nodal load = stiffness_sector_force(&sector, ring->roll[9]);
    apply(&r, 0, &load, b->x, NULL);
    cholmod_dense *x = cholmod_solve(CHOLMOD_A, factor, b, &common);
    compare_with_ring(&r, ring, x);
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&b, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&matrix, &common);
    cholmod_free_triplet(&t, &common);
    cholmod_finish(&common);
    stiffness_sector_free(&sector);
    stiffness_sector_free(&turned);
    free(r.number);
    free(r.left);
    free(ring);
}

static void test_reciprocity(void)
{
    stiffness_contour c = contour(31, 1.25);
    stiffness_ring *ring = malloc(sizeof *ring);
    check_true("ring", stiffness_ring_make(ring, &c, 20e-3, &steel, 300) == STIFFNESS_RING_MADE);
    check_below("points of one flank", ring->reciprocity, 1e-10);
    check_true("round-off of doubles is seen", ring->reciprocity > 1e-17);
    double worst = 0;
    for (int d = 1; d <= 5; d++)
        for (int i = 0; i < 20; i++) {
            double a = ring->roll_low + (ring->roll_high - ring->roll_low) * i / 19;
            double b = ring->roll_high - (a - ring->roll_low) / 2;
            worst = fmax(worst, fabs(stiffness_ring_other(ring, d, a, b) /
                                         stiffness_ring_other(ring, -d, b, a) -
                                     1));
        }
    check_below("different teeth", worst, 1e-10);
    free(ring);
}

static void test_compliance_converges(void)
{
    stiffness_contour c = contour(50, 1.25);
    stiffness_ring *ring = malloc(sizeof *ring);
    static const size_t elements[3] = {450, 900, 2700};
    double own[3], other[3], roll = 0.37;
    for (int i = 0; i < 3; i++) {
        check_true("ring", stiffness_ring_make(ring, &c, 35e-3, &steel, elements[i]) ==
                               STIFFNESS_RING_MADE);
        own[i] = stiffness_ring_own(ring, roll);
        other[i] = stiffness_ring_other(ring, 1, roll, roll);
    }
    check_near("own, 900 elements", own[1], own[2], 1e-3);
    check_near("own, 450 elements", own[0], own[2], 3e-3);
    check_near("other", other[1], other[2], 2e-4);
    free(ring);
}

/* Returns the approach of flank and axis under an elliptical pressure of a half width, minus that
   of a half-plane (Johnson 1985 eq. 5.57), times the face width. */
static double beyond_half_plane(const stiffness_sector *sector, double roll, double half_width)
{
    enum { PARTS = 200 };
    static stiffness_nodal part[PARTS + 2];
    stiffness_flank_force middle = stiffness_contour_force(sector->contour, roll);
    for (int k = 0; k < PARTS; k++) {
        double angle = M_PI * (k + 0.5) / PARTS;
        part[k] = stiffness_sector_force(sector, roll + half_width * cos(angle) /
                                                            (sector->contour->base_radius * roll));
        part[k].direction = middle.direction;
        for (int n = 0; n < 3; n++)
            part[k].weight[n] *= 2 * sin(angle) * sin(angle) / PARTS;
    }
    part[PARTS] = stiffness_sector_force(sector, roll);
    part[PARTS + 1] = stiffness_sector_axis(sector, roll);
    part[PARTS].load = 1;
    part[PARTS + 1].load = 2;
    stiffness_condensed c;
    check_true("condensed",
               stiffness_condense(&c, sector, &steel, 3, PARTS + 2, part) == STIFFNESS_CONDENSED);
    double approach = c.held[1 * 3 + 0] - c.held[2 * 3 + 0];
    stiffness_condensed_free(&c);
    double formula = 2 * (1 - 0.09) / (M_PI * steel.elastic_modulus * steel.width) *
                     (log(2 * middle.depth / half_width) - 0.3 / 1.4);
    printf("pressure %.2g of the depth, roll %.3f: nearer by %.1f %%\n", half_width / middle.depth,
           roll, 100 * (approach / formula - 1));
    return approach - formula;
}

/* The difference of a tooth's compliance from that of a half-plane must not depend on the width of
   the pressure. */
static void test_local_part(void)
{
    stiffness_contour c = contour(50, 1.25);
    stiffness_sector sector;
    stiffness_ring *ring = malloc(sizeof *ring);
    check_true("made", stiffness_ring_make(ring, &c, 35e-3, &steel, 900) == STIFFNESS_RING_MADE &&
                           stiffness_sector_make(&sector, &c, 35e-3, 2700));
    double roll = ring->roll_low + 0.7 * (ring->roll_high - ring->roll_low);
    double own = stiffness_ring_own(ring, roll), depth = stiffness_contour_force(&c, roll).depth;
    double wide = beyond_half_plane(&sector, roll, 0.3 * depth);
    check_below("same on a finer mesh", fabs(ring->thin[1] - wide) / own, 1e-3);
    for (int i = 0; i < 2; i++) {
        double off =
            (beyond_half_plane(&sector, roll, (0.2 + 0.2 * i) * depth) - ring->thin[1]) / own;
        printf("pressure %.2g of the depth: own compliance %+.2f %%\n", 0.2 + 0.2 * i, 100 * off);
        check_below("and of another width", fabs(off), 4e-3);
    }
    stiffness_sector_free(&sector);
    free(ring);
}

/* Torsion of an annulus between radii r_i and r_o: under a unit force at the base circle, this
   circle must move by r_b^2/(4 pi G b) (1/r_i^2 - 1/r_o^2). */
static void test_torsion_of_the_body(void)
{
    stiffness_contour c = contour(50, 1.25);
    stiffness_ring *wide = malloc(sizeof *wide), *narrow = malloc(sizeof *narrow);
    double inner = 20e-3, outer = 30e-3;
    check_true("rings",
               stiffness_ring_make(wide, &c, inner, &steel, 900) == STIFFNESS_RING_MADE &&
                   stiffness_ring_make(narrow, &c, outer, &steel, 900) == STIFFNESS_RING_MADE);
    double shear = 206e9 / 2.6, r = c.base_radius;
    check_near("difference of two rims", wide->turning - narrow->turning,
               r * r / (4 * M_PI * shear * steel.width) *
                   (1 / (inner * inner) - 1 / (outer * outer)),
               2e-3);
    free(wide);
    free(narrow);
}

int main(void)
{
    test_contour();
    test_undercut_fillet();
    test_largest_fillet();
    test_contours_that_do_not_exist();
    test_patch();
    test_twin_of_the_whole_ring();
    test_reciprocity();
    test_compliance_converges();
    test_local_part();
    test_torsion_of_the_body();
    return check_done();
}
