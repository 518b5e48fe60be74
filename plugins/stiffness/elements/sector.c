/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finite element mesh of one sector of a gear. */
#include "sector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The contour as a function of its arc length, tabulated at equal steps of its parameter. */
enum { TABLE = 600 };
typedef struct arc_table {
    const stiffness_contour *contour;
    double p[TABLE + 1], length[TABLE + 1];
} arc_table;

static void arc_table_make(arc_table *m, const stiffness_contour *o, double from, double to)
{
    m->contour = o;
    m->length[0] = 0;
    stiffness_point last = stiffness_contour_at(o, from);
    for (int i = 0; i <= TABLE; i++) {
        m->p[i] = from + (to - from) * i / TABLE;
        stiffness_point at = stiffness_contour_at(o, m->p[i]);
        if (i > 0)
            m->length[i] = m->length[i - 1] + hypot(at.x - last.x, at.y - last.y);
        last = at;
    }
}

/* Returns the point of the contour at the given fraction of its length. */
static stiffness_point arc_table_at(const arc_table *m, double fraction)
{
    double length = fraction * m->length[TABLE];
    int low = 0, high = TABLE;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        *(m->length[middle] <= length ? &low : &high) = middle;
    }
    double step = m->length[high] - m->length[low];
    double t = step > 0 ? (length - m->length[low]) / step : 0;
    return stiffness_contour_at(m->contour, m->p[low] + t * (m->p[high] - m->p[low]));
}

/* Numbers of elements: across the tooth, across half of the space, along the flank, through the
 * body. */
typedef struct counts {
    size_t tooth, space, flank, body;
} counts;

static counts choose_counts(size_t elements)
{
    /* 2q elements across the tooth, 2q along the flank, q across each half of the space, 5q/2
       through the body */
    double q = sqrt((double)elements / 14);
    size_t half = (size_t)fmax(2, round(q));
    return (counts){2 * half, half, 2 * half, (size_t)fmax(4, round(2.5 * q))};
}

static size_t *cell(const stiffness_sector *s, size_t row, size_t column)
{
    return &s->grid[row * s->columns + column];
}

/* Returns whether the grid has a node here. Eight-node elements have no node in their middle;
   outside the body, only the tooth has nodes. */
static int has_node(const stiffness_sector *s, size_t row, size_t column)
{
    if (row % 2 == 1 && column % 2 == 1)
        return 0;
    return row < s->body_rows || (column >= s->tooth_from && column <= s->tooth_to);
}

/* Numbers the nodes of the grid, and lists the nodes of each element. Returns 0 if out of
   memory. */
static int number_nodes(stiffness_sector *s, const counts *c)
{
    s->body_rows = 2 * c->body + 1;
    s->rows = s->body_rows + 2 * c->flank;
    s->columns = 2 * (c->tooth + 2 * c->space) + 1;
    s->tooth_from = 2 * c->space;
    s->tooth_to = s->tooth_from + 2 * c->tooth;
    s->grid = malloc(s->rows * s->columns * sizeof *s->grid);
    s->node = malloc(s->rows * s->columns * sizeof *s->node);
    s->element = malloc(s->rows * s->columns * sizeof *s->element);
    if (!s->grid || !s->node || !s->element)
        return 0;
    for (size_t i = 0; i < s->rows; i++)
        for (size_t j = 0; j < s->columns; j++)
            *cell(s, i, j) = has_node(s, i, j) ? s->nodes++ : STIFFNESS_NO_NODE;
    for (size_t i = 0; i + 2 < s->rows; i += 2)
        for (size_t j = 0; j + 2 < s->columns; j += 2) {
            if (*cell(s, i + 2, j) == STIFFNESS_NO_NODE ||
                *cell(s, i + 2, j + 2) == STIFFNESS_NO_NODE)
                continue;
            /* row numbers increase along x, column numbers along y */
            const size_t at[8][2] = {{i, j},     {i + 2, j},     {i + 2, j + 2}, {i, j + 2},
                                     {i + 1, j}, {i + 2, j + 1}, {i + 1, j + 2}, {i, j + 1}};
            for (int k = 0; k < 8; k++)
                s->element[s->elements][k] = *cell(s, at[k][0], at[k][1]);
            s->elements++;
        }
    return 1;
}

/* Returns the outer end of a column of the body. Beside the tooth it is on the contour (the root
 * land or the lower part of a fillet), below the tooth on the chord between the two fillets. */
static stiffness_point body_end(const stiffness_sector *s, const arc_table *root, size_t column)
{
    size_t last = s->columns - 1, from = s->tooth_from;
    size_t mirrored = column > last / 2 ? last - column : column;
    double sign = column > last / 2 ? 1 : -1;
    stiffness_point at;
    if (mirrored <= from) {
        at = arc_table_at(root, (double)mirrored / (double)from);
        at.y *= sign;
        return at;
    }
    at = arc_table_at(root, 1);
    at.y *= 2 * (double)(column - from) / (double)(s->tooth_to - from) - 1;
    return at;
}

/* The steps through the body grow inwards in a geometric series, with a ratio between 1 and 4;
   `first` is the first step over the depth of the body. fraction[i] is the part of the depth
   between the rim and row i. */
static void grade(double *fraction, size_t steps, double first)
{
    double low = 1, high = 4;
    for (int k = 0; k < 60; k++) {
        double g = (low + high) / 2;
        double sum = g > 1 ? first * (pow(g, (double)steps) - 1) / (g - 1) : first * (double)steps;
        *(sum > 1 ? &high : &low) = g;
    }
    double sum = 0, step = 1;
    for (size_t i = 0; i < steps; i++, step *= low)
        sum += step;
    fraction[2 * steps] = 1;
    step = 1 / sum;
    for (size_t i = steps; i-- > 0; step *= low) {
        fraction[2 * i] = i ? fraction[2 * i + 2] - step : 0;
        fraction[2 * i + 1] = (fraction[2 * i] + fraction[2 * i + 2]) / 2;
    }
}

static void place_body(stiffness_sector *s, const arc_table *root, double rim,
                       const double *fraction)
{
    for (size_t j = 0; j < s->columns; j++) {
        stiffness_point end = body_end(s, root, j);
        double radius = hypot(end.x, end.y);
        for (size_t i = 0; i < s->body_rows; i++) {
            size_t n = *cell(s, i, j);
            double r = rim / radius + (1 - rim / radius) * fraction[i];
            if (n != STIFFNESS_NO_NODE)
                s->node[n] = (stiffness_point){end.x * r, end.y * r};
        }
    }
}

/* Places the rows across the tooth. They are straight at the fillets and gradually approach the
   curvature of the tip circle. */
static void place_tooth(stiffness_sector *s, const arc_table *flank)
{
    double tip = s->contour->tip_radius;
    size_t steps = s->rows - s->body_rows;
    for (size_t i = s->body_rows; i < s->rows; i++) {
        double along = (double)(i - s->body_rows + 1) / (double)steps;
        stiffness_point side = arc_table_at(flank, along);
        for (size_t j = s->tooth_from; j <= s->tooth_to; j++) {
            size_t n = *cell(s, i, j);
            if (n == STIFFNESS_NO_NODE)
                continue;
            double across =
                2 * (double)(j - s->tooth_from) / (double)(s->tooth_to - s->tooth_from) - 1;
            double y = across * side.y;
            double arc = sqrt(tip * tip - y * y) - sqrt(tip * tip - side.y * side.y);
            s->node[n] = (stiffness_point){side.x + along * arc, y};
        }
    }
}

int stiffness_sector_make(stiffness_sector *s, const stiffness_contour *contour, double rim_radius,
                          size_t elements)
{
    *s = (stiffness_sector){.contour = contour};
    counts c = choose_counts(elements);
    arc_table *m = malloc(2 * sizeof *m);
    double *fraction = malloc((2 * c.body + 1) * sizeof *fraction);
    int made = m && fraction && number_nodes(s, &c);
    if (made) {
        double middle = stiffness_contour_middle(contour);
        arc_table_make(&m[0], contour, 0, middle);
        arc_table_make(&m[1], contour, middle, 3);
        double size = 2 * stiffness_contour_at(contour, middle).y / (double)c.tooth;
        grade(fraction, c.body, size / (contour->root_radius - rim_radius));
        place_body(s, &m[0], rim_radius, fraction);
        place_tooth(s, &m[1]);
    }
    free(m);
    free(fraction);
    return made;
}

void stiffness_sector_free(stiffness_sector *s)
{
    free(s->node);
    free(s->element);
    free(s->grid);
    *s = (stiffness_sector){0};
}

/* Shape functions of an element side with three nodes, -1 <= t <= 1. */
static void side_shape(double t, double n[3])
{
    n[0] = t * (t - 1) / 2;
    n[1] = 1 - t * t;
    n[2] = t * (t + 1) / 2;
}

/* Finds the point of a column of nodes, from first_row outwards, at a given distance from the
   gear's centre: the element side that contains it, and the shape functions there. */
static stiffness_nodal locate(const stiffness_sector *s, size_t column, size_t first_row,
                              double height)
{
    stiffness_nodal f = {0};
    double value[3] = {0};
    size_t row = first_row;
    for (;; row += 2) {
        for (size_t k = 0; k < 3; k++) {
            f.node[k] = *cell(s, row + k, column);
            stiffness_point at = s->node[f.node[k]];
            value[k] = hypot(at.x, at.y);
        }
        if (height <= value[2] || row + 4 >= s->rows)
            break;
    }
    double low = -1, high = 1;
    for (int i = 0; i < 60; i++) {
        double t = (low + high) / 2;
        side_shape(t, f.weight);
        double there = f.weight[0] * value[0] + f.weight[1] * value[1] + f.weight[2] * value[2];
        *(there < height ? &low : &high) = t;
    }
    return f;
}

stiffness_nodal stiffness_sector_force(const stiffness_sector *s, double roll)
{
    stiffness_flank_force force = stiffness_contour_force(s->contour, roll);
    stiffness_nodal f = locate(s, s->tooth_to, s->body_rows - 1, force.radius);
    f.direction = force.direction;
    return f;
}

stiffness_nodal stiffness_sector_axis(const stiffness_sector *s, double roll)
{
    stiffness_flank_force force = stiffness_contour_force(s->contour, roll);
    stiffness_nodal f = locate(s, (s->tooth_from + s->tooth_to) / 2, 0, force.axis_x);
    f.direction = force.direction;
    return f;
}

/* Derivatives of the shape functions of the eight-node element. Nodes: corners counter-clockwise
   from (-1, -1), then the middles of the sides, starting with the first side. */
static void shape_slopes(double a, double b, double da[8], double db[8])
{
    static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int k = 0; k < 4; k++) {
        double p = corner[k][0], q = corner[k][1];
        da[k] = p * (1 + q * b) * (2 * p * a + q * b) / 4;
        db[k] = q * (1 + p * a) * (2 * q * b + p * a) / 4;
    }
    da[4] = -a * (1 - b);
    db[4] = -(1 - a * a) / 2;
    da[5] = (1 - b * b) / 2;
    db[5] = -b * (1 + a);
    da[6] = -a * (1 + b);
    db[6] = (1 - a * a) / 2;
    da[7] = -(1 - b * b) / 2;
    db[7] = -b * (1 - a);
}

/* Hooke's law in the plane: sigma_x = d e_x + c e_y, tau = g gamma, times the width. */
typedef struct hooke {
    double d, c, g;
} hooke;

static hooke hooke_of(const stiffness_material *m)
{
    double e = m->elastic_modulus, nu = m->poisson_ratio;
    double g = e / (2 * (1 + nu)) * m->width;
    if (m->plane_strain) {
        e /= 1 - nu * nu;
        nu /= 1 - nu;
    }
    double d = e / (1 - nu * nu) * m->width;
    return (hooke){d, nu * d, g};
}

void stiffness_sector_stiffness(const stiffness_sector *s, size_t element,
                                const stiffness_material *material, double k[16][16])
{
    /* Gauss's rule with 3 x 3 points, at +-sqrt(3/5) and 0 */
    static const double place[3] = {-0.77459666924148337704, 0, 0.77459666924148337704};
    static const double weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    const hooke h = hooke_of(material);
    memset(k, 0, 16 * sizeof *k);
    for (int point = 0; point < 9; point++) {
        double da[8], db[8], j[4] = {0}, gx[8], gy[8];
        shape_slopes(place[point / 3], place[point % 3], da, db);
        for (int n = 0; n < 8; n++) {
            stiffness_point at = s->node[s->element[element][n]];
            j[0] += da[n] * at.x;
            j[1] += da[n] * at.y;
            j[2] += db[n] * at.x;
            j[3] += db[n] * at.y;
        }
        double det = j[0] * j[3] - j[1] * j[2];
        double w = weight[point / 3] * weight[point % 3] * det;
        for (int n = 0; n < 8; n++) {
            gx[n] = (j[3] * da[n] - j[1] * db[n]) / det;
            gy[n] = (j[0] * db[n] - j[2] * da[n]) / det;
        }
        for (int n = 0; n < 8; n++)
            for (int m = 0; m < 8; m++) {
                k[2 * n][2 * m] += w * (h.d * gx[n] * gx[m] + h.g * gy[n] * gy[m]);
                k[2 * n][2 * m + 1] += w * (h.c * gx[n] * gy[m] + h.g * gy[n] * gx[m]);
                k[2 * n + 1][2 * m] += w * (h.c * gy[n] * gx[m] + h.g * gx[n] * gy[m]);
                k[2 * n + 1][2 * m + 1] += w * (h.d * gy[n] * gy[m] + h.g * gx[n] * gx[m]);
            }
    }
}
