/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A page of figures alone, from a file that describes them: `report map.figure.json`. */
#include "../memory/memory.h"
#include "../report/report.h"
#include "../results/json.h"
#include "command.h"

#include <errno.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

bool cli_names_figures(const char *operand)
{
    size_t length = strlen(operand);
    return length > 5 && !strcmp(operand + length - 5, ".json");
}

static bool write_page(const char *from, const char *to, ff_report *report)
{
    json_error_t error;
    json_t *figures = json_load_file(from, 0, &error);
    FILE *out = json_is_array(figures) ? fopen(to, "we") : NULL;
    bool good = out != NULL;
    if (!json_is_array(figures))
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "\"%s\" does not describe figures: %s",
                 from, figures ? "it is no list" : error.text);
    if (out) {
        char *text = json_dumps(figures, JSON_COMPACT);
        report_write_figures(out, from, text);
        free(text);
        good = ferror(out) == 0;
        good = fclose(out) == 0 && good;
    }
    if (json_is_array(figures) && !good)
        ff_error(report, FF_FAULT_RUN, FF_NOWHERE, NULL, "\"%s\" could not be written: %s", to,
                 strerror(errno ? errno : EIO));
    json_decref(figures);
    return good;
}

int cli_report_figures(const cli_options *options)
{
    ff_report *report = ff_report_new();
    const char *from = options->operand;
    char *to = options->directory
                   ? memory_print_text("%s", options->directory)
                   : memory_print_text("%.*s.html", (int)(strlen(from) - strlen(".json")), from);
    int code = EXIT_SUCCESS;
    if (!write_page(from, to, report)) {
        code = cli_refuse(report, options, "nothing was written");
    } else if (options->json) {
        json_t *answer = results_json_answer("ok", code, report);
        json_object_set_new(answer, "path", results_json_text(to));
        results_json_print(answer);
    } else {
        printf("%s\n", to);
    }
    free(to);
    ff_report_free(report);
    return code;
}
