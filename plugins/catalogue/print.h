/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the printers of the catalogue. */
#ifndef CATALOGUE_PRINT_H
#define CATALOGUE_PRINT_H

#include <flankfilm/catalogue.h>
#include <flankfilm/rows.h>

#include <jansson.h>
#include <stdbool.h>

/* What each printer states of itself; offer.c makes the model of it. */
extern const char catalogue_id[], catalogue_summary[];
ff_status catalogue_print(void *self, const ff_catalogue *catalogue);

/* print.c */
bool can_assess(const ff_model *model);
/* Length of the kind in "kind/name". */
size_t kind_length(const char *id);

/* What may be written, "2 numbers in mm"; the limits, "above 0 to 10; calibrated from 1 to 5", ""
   without any. */
const char *type_name(const ff_param *row);
void type_print(const ff_param *row, char *out, size_t size);
void limits_print(const ff_param *row, char *out, size_t size);

char *format(const char *words, ...) FF_PRINTF(1, 2); /* as printf does, to be freed */
/* Puts as printf does; returns the number of bytes. */
int put(const ff_catalogue *catalogue, const char *words, ...) FF_PRINTF(2, 3);
/* Puts the value and frees it. */
ff_status put_json(const ff_catalogue *catalogue, json_t *value, size_t flags);
json_t *json_text(const char *text); /* null for NULL */
json_t *json_number(double value);   /* null for what is not finite */

#endif
