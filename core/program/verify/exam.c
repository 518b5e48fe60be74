/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a verifier may call. */
#include "private.h"

#include "../../engine/plugin/clean.h"
#include "../../engine/plugin/param.h"
#include "../../engine/value/memory.h"
#include "../../engine/value/tables.h"

#include <stdlib.h>
#include <string.h>

typedef struct kept {
    fe_tables tables;
    char why[300];
} kept;

static void *open_tables(void)
{
    return fe_alloc(sizeof(kept));
}

static void close_tables(void *ctx)
{
    fe_tables_free(&((kept *)ctx)->tables);
    free(ctx);
}

static ff_status read_table(void *ctx, const char *item, const char *path, const ff_param *rows,
                            size_t count, size_t stride, const ff_table **table)
{
    return fe_tables_read(&((kept *)ctx)->tables, item, path, rows, count, stride, table);
}

static ff_status fail_table(void *ctx, const ff_table *table, size_t row, size_t column,
                            const char *text)
{
    return fe_tables_fail(&((kept *)ctx)->tables, table, row, column, text);
}

static const char *tell_why(void *ctx, const char **item)
{
    kept *k = ctx;
    *item = k->tables.item;
    if (!k->tables.said)
        return NULL;
    fe_tables_print(&k->tables, k->why, sizeof k->why);
    return k->why;
}

void verify_slate_say(verify_slate *slate, verify_finding finding, const char *text)
{
    if (slate->finding == VERIFY_PASSED) {
        slate->finding = finding;
        fe_clean_text(slate->why, sizeof slate->why, text);
    }
}

static void doing(void *ctx, const char *text)
{
    verify_slate *slate = ((verify_examined *)ctx)->slate;
    snprintf(slate->doing, sizeof slate->doing, "%s", text);
}

static void fault(void *ctx, const char *text)
{
    verify_slate_say(((verify_examined *)ctx)->slate, VERIFY_FAULTY, text);
}

static void untried(void *ctx, const char *text)
{
    verify_slate_say(((verify_examined *)ctx)->slate, VERIFY_UNTRIED, text);
}

static int32_t read_param(void *ctx, uint32_t param, const char *text, ff_value *value,
                          const char **said)
{
    verify_examined *subject = ctx;
    ff_param row = *ff_model_param(subject->loaded->model, param);
    row.preset = text ? text : row.preset;
    fe_report_free(subject->said);
    subject->said = fe_report_new();
    bool good = fe_param_read_preset(&row, &subject->loaded->param_units[param], row.name, value,
                                     subject->said);
    *said = fe_report_count(subject->said) ? fe_report_at(subject->said, 0)->text : NULL;
    return good;
}

static const char *find_change(void *ctx)
{
    const verify_examined *subject = ctx;
    const char *what = fe_environment_restore(&subject->environment);
    return what ? what : fe_surroundings_changed(&subject->around);
}

void verify_exam_begin(verify_examined *subject, fe_library *library)
{
    static const ff_table_keeper tables = {sizeof tables, open_tables, close_tables,
                                           read_table,    fail_table,  tell_why};
    const fe_loaded *loaded = subject->loaded;
    size_t count = loaded->model->param_count;
    double *factors = fe_alloc(count * sizeof *factors),
           *offsets = fe_alloc(count * sizeof *offsets);
    for (size_t i = 0; i < count; i++) {
        factors[i] = loaded->param_units[i].factor;
        offsets[i] = loaded->param_units[i].offset;
    }
    subject->exam = (ff_exam){.size = sizeof subject->exam,
                              .ctx = subject,
                              .model = loaded->model,
                              .factors = factors,
                              .offsets = offsets,
                              .laws = verify_plain_laws(library, loaded),
                              .doing = doing,
                              .fault = fault,
                              .untried = untried,
                              .read = read_param,
                              .disturbed = find_change,
                              .tables = &tables};
    fe_surroundings_keep(&subject->around);
    fe_environment_keep(&subject->environment);
}
