/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A page of figures alone, from a file that describes them: `report map.figure.json`. */
#include "../memory/memory.h"
#include "../report/report.h"
#include "../results/json.h"
#include "../results/target.h"
#include "../study/kinds/kinds.h"
#include "command.h"

#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

bool cli_names_figures(const char *operand)
{
    size_t length = strlen(operand);
    return length > 5 && !strcmp(operand + length - 5, ".json");
}

static bool write_page(const char *from, results_target *target)
{
    json_error_t error;
    json_t *figures = study_read_json(AT_FDCWD, from, &error);
    bool good = json_is_array(figures) || ff_error(target->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                                                   "\"%s\" does not describe figures: %s", from,
                                                   figures ? "it is no list" : error.text);
    FILE *out = good && results_target_open(target, false) ? fopen(target->part, "we") : NULL;
    if (out) {
        char *text = json_dumps(figures, JSON_COMPACT);
        report_write_figures(out, from, text);
        free(text);
    }
    json_decref(figures);
    return good && results_target_end(target, out);
}

int cli_report_figures(const cli_options *options)
{
    const char *from = options->operand;
    results_target target = {.report = ff_report_new(), .begins = REPORT_BEGINS};
    target.path = options->directory
                      ? memory_print_text("%s", options->directory)
                      : memory_print_text("%.*s.html", (int)(strlen(from) - strlen(".json")), from);
    int code = EXIT_SUCCESS;
    if (!write_page(from, &target)) {
        code = cli_refuse(target.report, options, "nothing was written");
    } else if (options->json) {
        json_t *answer = results_json_answer("ok", code, target.report);
        json_object_set_new(answer, "path", results_json_text(target.path));
        results_json_print(answer);
    } else {
        printf("%s\n", target.path);
    }
    results_target_close(&target);
    ff_report_free(target.report);
    return code;
}
