/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is written as YAML reads as itself. */
#include "../../../core/program/study/cases/yaml.h"

#include "check.h"

#include <stdlib.h>
#include <string.h>

int main(void)
{
    static const char *const texts[] = {
        "plain", "",   " x",   "x ",  "-",  "- x",  "-3",    "?",         ". x",
        "a, b",  "[a", "a: b", "a:b", "#",  "it's", "\"q\"", "b\\c",      "a\tb",
        "a\nb",  "%",  "@x",   "&x",  "*x", "!x",   "|",     "\x01 \x7f", "{a: 1}"};
    ff_engine *engine;
    ff_engine_new(NULL, &engine);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char *line = NULL;
        size_t length = 0;
        FILE *out = open_memstream(&line, &length);
        fputs("a: {b: ", out);
        study_yaml_print_text(texts[i], false, out);
        fputs("}\n", out);
        fclose(out);
        ff_run *run;
        ff_status status = ff_run_parse(engine, "printed", ".", line, &run);
        const ff_node *node = ff_node_get(ff_node_get(ff_run_root(run), "a"), "b");
        check_true(line, status == FF_OK && node && !strcmp(node->text, texts[i]));
        ff_run_close(run);
        free(line);
    }
    ff_engine_close(engine);
    return check_done();
}
