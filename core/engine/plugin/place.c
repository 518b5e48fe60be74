/* SPDX-License-Identifier: MIT */
/* Writes parameter values into the instance members given by their rows. */
#include <flankfilm/engine.h>

#include "param.h"

#include <math.h>
#include <stdalign.h>
#include <string.h>

fe_member fe_param_member(int32_t type)
{
    switch (type) {
    case FF_REAL:
        return (fe_member){sizeof(double), alignof(double)};
    case FF_INT:
        return (fe_member){sizeof(int64_t), alignof(int64_t)};
    case FF_BOOL:
    case FF_CHOICE:
        return (fe_member){sizeof(int32_t), alignof(int32_t)};
    case FF_REALS:
        return (fe_member){sizeof(ff_reals), alignof(ff_reals)};
    default:
        return (fe_member){sizeof(const char *), alignof(const char *)};
    }
}

static void write(const ff_param *row, void *self, const void *value)
{
    memcpy((char *)self + row->place - 1, value, fe_param_member(row->type).size);
}

void fe_param_place(const ff_param *row, void *self, const ff_value *value)
{
    static const ff_value not_given = {.real = NAN, .integer = -1};
    bool word = value && value->text && (row->type == FF_REAL || row->type == FF_INT);
    const ff_value *held = value && !word ? value : &not_given;
    int32_t rank = (int32_t)held->integer;
    switch (row->type) {
    case FF_REAL:
        write(row, self, &held->real);
        break;
    case FF_INT:
        write(row, self, &held->integer);
        break;
    case FF_BOOL:
    case FF_CHOICE:
        write(row, self, &rank);
        break;
    case FF_REALS:
        write(row, self, &(ff_reals){held->reals, held->count});
        break;
    default:
        write(row, self, &held->text);
    }
}
