/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The layout of the public structs of interface 1, on machines of 64-bit longs and pointers: what a
 * plugin was compiled with holds for ever. Fields are added at the end of structs that begin with
 * `size` and of rows that have a stride, and get their line here; ff_array can never change.
 */
#include <flankfilm/estimates.h>
#include <flankfilm/laws.h>
#include <flankfilm/needs.h>
#include <flankfilm/table.h>

#include <assert.h>

#if defined(__LP64__)

#define FIELD(type, field, offset, size)                                                           \
    static_assert(offsetof(type, field) == (offset) && sizeof(((type *)0)->field) == (size),       \
                  #type "." #field " has moved")
#define FROZEN(type, size)  static_assert(sizeof(type) == (size), #type " has another size")
#define GROWING(type, size) static_assert(sizeof(type) >= (size), #type " has shrunk")

GROWING(ff_param, 96);
FIELD(ff_param, name, 0, 8);
FIELD(ff_param, unit, 8, 8);
FIELD(ff_param, doc, 16, 8);
FIELD(ff_param, type, 24, 4);
FIELD(ff_param, flags, 28, 4);
FIELD(ff_param, preset, 32, 8);
FIELD(ff_param, choices, 40, 8);
FIELD(ff_param, group, 48, 8);
FIELD(ff_param, min, 56, 8);
FIELD(ff_param, max, 64, 8);
FIELD(ff_param, low, 72, 8);
FIELD(ff_param, high, 80, 8);
FIELD(ff_param, min_count, 88, 4);
FIELD(ff_param, max_count, 92, 4);
FIELD(ff_param, place, 96, 8);    /* since 1.2 */
FIELD(ff_param, instead, 104, 8); /* since 1.2 */

FROZEN(ff_reals, 16); /* since 1.2 */
FIELD(ff_reals, data, 0, 8);
FIELD(ff_reals, count, 8, 8);

GROWING(ff_port, 56);
FIELD(ff_port, name, 0, 8);
FIELD(ff_port, unit, 8, 8);
FIELD(ff_port, doc, 16, 8);
FIELD(ff_port, dims, 24, 8);
FIELD(ff_port, service, 32, 8);
FIELD(ff_port, flags, 40, 4);
FIELD(ff_port, from, 48, 8);
FIELD(ff_port, min, 56, 8); /* since 1.3 */
FIELD(ff_port, max, 64, 8);
FIELD(ff_port, label, 72, 8);
FIELD(ff_port, shown, 80, 8);
FIELD(ff_port, quantity, 88, 8);
FIELD(ff_port, origin, 96, 8);
FIELD(ff_port, headline, 104, 4);
FIELD(ff_port, apart, 112, 8);

GROWING(ff_value, 64);
FIELD(ff_value, size, 0, 8);
FIELD(ff_value, real, 8, 8);
FIELD(ff_value, integer, 16, 8);
FIELD(ff_value, text, 24, 8);
FIELD(ff_value, reals, 32, 8);
FIELD(ff_value, count, 40, 8);
FIELD(ff_value, given, 48, 4);
FIELD(ff_value, tree, 56, 8);

FROZEN(ff_array, 24);
FIELD(ff_array, data, 0, 8);
FIELD(ff_array, shape, 8, 8);
FIELD(ff_array, rank, 16, 4);

GROWING(ff_host, 72);
FIELD(ff_host, size, 0, 8);
FIELD(ff_host, abi_minor, 8, 4);
FIELD(ff_host, ctx, 16, 8);
FIELD(ff_host, fail, 24, 8);
FIELD(ff_host, log, 32, 8);
FIELD(ff_host, output, 40, 8);
FIELD(ff_host, quality, 48, 8);
FIELD(ff_host, progress, 56, 8);
FIELD(ff_host, extension, 64, 8);
FIELD(ff_host, wanted, 72, 8); /* since 1.2 */
FIELD(ff_host, given, 80, 8);  /* since 1.2 */
FIELD(ff_host, serves, 88, 8); /* since 1.2 */

GROWING(ff_model, 200);
FIELD(ff_model, size, 0, 8);
FIELD(ff_model, abi_major, 8, 4);
FIELD(ff_model, abi_minor, 12, 4);
FIELD(ff_model, id, 16, 8);
FIELD(ff_model, version, 24, 8);
FIELD(ff_model, summary, 32, 8);
FIELD(ff_model, reference, 40, 8);
FIELD(ff_model, bibtex, 48, 8);
FIELD(ff_model, licence, 56, 8);
FIELD(ff_model, flags, 64, 4);
FIELD(ff_model, params, 72, 8);
FIELD(ff_model, param_count, 80, 8);
FIELD(ff_model, param_stride, 88, 8);
FIELD(ff_model, inputs, 96, 8);
FIELD(ff_model, input_count, 104, 8);
FIELD(ff_model, input_stride, 112, 8);
FIELD(ff_model, outputs, 120, 8);
FIELD(ff_model, output_count, 128, 8);
FIELD(ff_model, output_stride, 136, 8);
FIELD(ff_model, create, 144, 8);
FIELD(ff_model, set, 152, 8);
FIELD(ff_model, wire, 160, 8);
FIELD(ff_model, ready, 168, 8);
FIELD(ff_model, evaluate, 176, 8);
FIELD(ff_model, service, 184, 8);
FIELD(ff_model, destroy, 192, 8);
FIELD(ff_model, carry, 200, 8); /* since 1.1 */
FIELD(ff_model, reserved, 208, 16);
FIELD(ff_model, columns, 224, 8); /* since 1.1 */
FIELD(ff_model, column_count, 232, 8);
FIELD(ff_model, column_stride, 240, 8);
FIELD(ff_model, self_size, 248, 8); /* since 1.2 */
FIELD(ff_model, cost, 256, 8);      /* since 1.2 */

GROWING(ff_state_bytes, 24);
FIELD(ff_state_bytes, size, 0, 8);
FIELD(ff_state_bytes, bytes, 8, 8);
FIELD(ff_state_bytes, count, 16, 8);

GROWING(ff_liquid, 24); /* since 1.2 */
FIELD(ff_liquid, size, 0, 8);
FIELD(ff_liquid, self, 8, 8);
FIELD(ff_liquid, eval, 16, 8);

GROWING(ff_rheology_2, 24); /* since 1.2 */
FIELD(ff_rheology_2, size, 0, 8);
FIELD(ff_rheology_2, self, 8, 8);
FIELD(ff_rheology_2, rate, 16, 8);

GROWING(ff_estimates, 16); /* since 1.3 */
FIELD(ff_estimates, size, 0, 8);
FIELD(ff_estimates, read, 8, 8);

GROWING(ff_needs, 16); /* since 1.3 */
FIELD(ff_needs, size, 0, 8);
FIELD(ff_needs, tell, 8, 8);

GROWING(ff_rheology_3, 32); /* since 1.3 */
FIELD(ff_rheology_3, size, 0, 8);
FIELD(ff_rheology_3, self, 8, 8);
FIELD(ff_rheology_3, flow, 16, 8);
FIELD(ff_rheology_3, shear, 24, 8);

GROWING(ff_asperity, 40); /* since 1.3 */
FIELD(ff_asperity, size, 0, 8);
FIELD(ff_asperity, self, 8, 8);
FIELD(ff_asperity, sigma, 16, 8);
FIELD(ff_asperity, pressure, 24, 8);
FIELD(ff_asperity, modulus, 32, 8);

GROWING(ff_viscosity, 24);
FIELD(ff_viscosity, size, 0, 8);
FIELD(ff_viscosity, self, 8, 8);
FIELD(ff_viscosity, eval, 16, 8);

GROWING(ff_density, 24);
FIELD(ff_density, size, 0, 8);
FIELD(ff_density, self, 8, 8);
FIELD(ff_density, eval, 16, 8);

GROWING(ff_rheology, 32);
FIELD(ff_rheology, size, 0, 8);
FIELD(ff_rheology, self, 8, 8);
FIELD(ff_rheology, flow, 16, 8);
FIELD(ff_rheology, shear, 24, 8);

GROWING(ff_table, 32);
FIELD(ff_table, size, 0, 8);
FIELD(ff_table, row_count, 8, 8);
FIELD(ff_table, columns, 16, 8);
FIELD(ff_table, lines, 24, 8);

GROWING(ff_table_reader, 24);
FIELD(ff_table_reader, size, 0, 8);
FIELD(ff_table_reader, read, 8, 8);
FIELD(ff_table_reader, fail, 16, 8);

#endif

/* Numbers that cross the border. */
#define VALUE(name, value) static_assert((name) == (value), #name " has another value")

VALUE(FF_ABI_MAJOR, 1);
VALUE(FF_OK, 0);
VALUE(FF_DOMAIN, 1);
VALUE(FF_NOCONV, 2);
VALUE(FF_STOPPED, 3);
VALUE(FF_INVALID, -1);
VALUE(FF_NOMEM, -2);
VALUE(FF_UNSUPPORTED, -3);
VALUE(FF_BUG, -4);
VALUE(FF_REAL, 1);
VALUE(FF_INT, 2);
VALUE(FF_BOOL, 3);
VALUE(FF_CHOICE, 4);
VALUE(FF_TEXT, 5);
VALUE(FF_REALS, 6);
VALUE(FF_FILE, 7);
VALUE(FF_TREE, 8);
VALUE(FF_REQUIRED, 1);
VALUE(FF_MIN_OPEN, 2);
VALUE(FF_MAX_OPEN, 4);
VALUE(FF_WHOLE, 8);
VALUE(FF_TUNABLE, 16);
VALUE(FF_INCREASING, 32);
VALUE(FF_OPTIONAL, 1);
VALUE(FF_FEEDBACK, 2);
VALUE(FF_DIFFERENCE, 4);
VALUE(FF_NO_HEADLINE, 0);
VALUE(FF_LEAST, 1);
VALUE(FF_LARGEST, 2);
VALUE(FF_MEAN, 3);
VALUE(FF_LIQUID_LN_ETA0, 0);
VALUE(FF_LIQUID_RHO0, 1);
VALUE(FF_LIQUID_CONDUCTIVITY, 2);
VALUE(FF_LIQUID_HEAT_CAPACITY, 3);
VALUE(FF_LIQUID_PRESSURE_COEFFICIENT, 4);
VALUE(FF_LIQUID_CONDUCTIVITY_RISE, 8);
VALUE(FF_LIQUID_CONDUCTIVITY_BEND, 9);
VALUE(FF_GOOD, 0);
VALUE(FF_DOUBTFUL, 1);
VALUE(FF_BAD, 2);
VALUE(FF_RANGE, 3);
VALUE(FF_LOG_INFO, 0);
VALUE(FF_LOG_WARNING, 1);
VALUE(FF_SERIAL, 1);

int main(void)
{
    return 0;
}
