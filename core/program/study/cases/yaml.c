/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints nodes in YAML's flow style. */
#include "yaml.h"

#include "../../memory/memory.h"

#include <string.h>

/* Returns whether YAML reads the text unchanged without quotes, even in a flow map. */
static bool is_plain(const char *text)
{
    size_t length = strlen(text);
    bool mark = (text[0] == '-' || text[0] == '?' || text[0] == '.') && strspn(text, "-?. ") > 0;
    bool number = text[0] && text[1] >= '0' && text[1] <= '9';
    return !strpbrk(text, ",[]{}#&*!|>'\"%@`\\:\n\r\t\x7f") && (!mark || number) &&
           text[0] != ' ' && (length == 0 || text[length - 1] != ' ');
}

void study_yaml_print_text(const char *text, bool quoted, FILE *out)
{
    if (!quoted && is_plain(text)) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (const char *at = text; *at; at++)
        if ((unsigned char)*at < 0x20 || *at == 0x7f)
            fprintf(out, "\\x%02x", (unsigned char)*at);
        else
            fprintf(out, "%s%c", *at == '"' || *at == '\\' ? "\\" : "", *at);
    fputc('"', out);
}

void study_yaml_print(const ff_node *node, FILE *out)
{
    if (node->kind == FF_SCALAR) {
        study_yaml_print_text(node->text, node->quoted, out);
        return;
    }
    fputc(node->kind == FF_MAP ? '{' : '[', out);
    for (size_t i = 0; i < node->count; i++) {
        fputs(i ? ", " : "", out);
        if (node->kind == FF_MAP) {
            study_yaml_print_text(node->keys[i], false, out);
            fputs(": ", out);
        }
        study_yaml_print(node->items[i], out);
    }
    fputc(node->kind == FF_MAP ? '}' : ']', out);
}

char *study_yaml_assignment(const char *path, const ff_node *value)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    fprintf(out, "%s=", path);
    study_yaml_print(value, out);
    fclose(out);
    return text;
}
