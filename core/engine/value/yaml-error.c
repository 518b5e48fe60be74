/* SPDX-License-Identifier: MIT */
/* Explains an error of libyaml to the writer of a file. */
#include <stdio.h>
#include <string.h>
#include <yaml.h>

#include "node.h"
#include "text.h"

/* The places that a message can refer to. */
enum { AT, BEGIN, LINE, COLON, PLACES };

typedef struct fault {
    const char *problem, *context; /* texts of libyaml; never NULL */
    ff_place places[PLACES]; /* by place: the problem; the start of the construct being read; the
                                first character of the line; a ":" that no blank follows (column 0:
                                none) */
    char c, opening;         /* the characters at AT and BEGIN; ' ' at the end of a line */
    bool after_colon;        /* the line has "key: " before the problem */
} fault;

/* Conditions of a rule. */
enum { ALWAYS, LATER_IN_LINE, AFTER_COLON, TIGHT_COLON };

/* The first applicable rule gives the message. If its text ends in a blank, the character is
   added. */
static const struct rule {
    const char *context, *problem; /* substrings of libyaml's texts */
    const char *characters;        /* allowed characters at AT; "": any */
    int when, where;
    const char *text, *hint;
} rules[] = {
    {"quoted scalar", "found unexpected", "", ALWAYS, BEGIN, "the quote opened here is not closed",
     NULL},
    {"quoted scalar", "", "", ALWAYS, AT, "this escape after \"\\\" is not known",
     "in \"...\" write \"\\\\\" for a backslash, or use '...'"},
    {"scanning an a", "", "", ALWAYS, BEGIN, /* libyaml's text for an anchor or an alias */
     "an anchor or alias needs a name of letters and digits",
     "put a text that begins with \"*\" or \"&\" in quotes"},
    {"tag", "", "", ALWAYS, BEGIN, "tags are not used in these files",
     "put a text that begins with \"!\" in quotes"},
    {"directive", "", "", ALWAYS, BEGIN, "this directive is not used in these files",
     "remove the line that begins with \"%\""},
    {"", "YAML", "", ALWAYS, AT, "this directive is not used in these files",
     "remove the line that begins with \"%\""},
    {"", "found", "\t", ALWAYS, AT, "a tab is used for indentation", "indent with spaces"},
    {"block scalar", "", "", ALWAYS, AT, "nothing may follow \"|\" or \">\" in its line",
     "begin the text in the next line"},
    {"", "cannot start any token", "", ALWAYS, AT, "a value cannot begin with ",
     "put the text in quotes"},
    {"", "are not allowed in this context", "-", ALWAYS, AT, "a list entry is not possible here",
     "begin the list in the line below its key"},
    {"", "are not allowed in this context", "", AFTER_COLON, AT,
     "there is a second \": \" in this line", "put a text that contains \": \" in quotes"},
    {"", "are not allowed in this context", "", ALWAYS, LINE,
     "this line is indented deeper than the line above allows",
     "indent it like the other keys of its map"},
    {"plain scalar", "found unexpected ':'", "", ALWAYS, AT,
     "a \":\" is not possible here inside brackets",
     "write a space after it, or put the text in quotes"},
    {"simple key", "could not find expected ':'", "", TIGHT_COLON, COLON,
     "a space is missing after \":\"", "write \"key: value\""},
    {"simple key", "could not find expected ':'", "", ALWAYS, BEGIN,
     "this line has no \":\" after its key",
     "write \"key: value\", or \"- value\" for an entry of a list"},
    {"", "expected node content", "\n", ALWAYS, AT, "a value is missing here", NULL},
    {"", "expected node content", "", ALWAYS, AT, "a value is missing before ", NULL},
    {"", "expected", "]}", ALWAYS, AT, "this bracket closes nothing",
     "remove it, or add the bracket that opens"},
    {"block mapping", "expected key", ":", ALWAYS, AT, "a key is missing before \":\"",
     "write \"key: value\""},
    {"block mapping", "expected key", "", LATER_IN_LINE, AT,
     "there is text after the end of the value",
     "quote the whole value; inside '...' an apostrophe is written twice"},
    {"block mapping", "expected key", "-", ALWAYS, AT, "there is a list entry in place of a key",
     "indent the list under its key"},
    {"block mapping", "expected key", "", ALWAYS, AT,
     "this line's indentation fits none of the lines above",
     "keys of one map begin in the same column"},
    {"block collection", "expected '-'", "", ALWAYS, AT,
     "this line is not an entry of the list above",
     "entries of one list begin with \"- \" in the same column"},
    {"", "expected <document start>", "", ALWAYS, AT,
     "there is text after the end of the document's value", NULL},
};

static ff_place place_at(const ff_source *source, const yaml_mark_t *mark)
{
    return (ff_place){
        .source = source, .line = (uint32_t)mark->line + 1, .column = (uint32_t)mark->column + 1};
}

static char char_at(const ff_place *place)
{
    const char *end, *at = fe_text_at(place, &end);
    return at < end ? *at : '\n';
}

/* Finds the first ":" behind the place, in the same line, that no blank follows. */
static ff_place find_tight_colon(ff_place place)
{
    const char *end, *at = fe_text_at(&place, &end);
    uint32_t code;
    for (; at + 1 < end; place.column++) {
        if (*at == ':' && at[1] != ' ' && at[1] != '\t')
            return place;
        at += fe_char_read(at, end, &code);
    }
    place.column = 0;
    return place;
}

static void look_at_line(fault *s)
{
    const ff_place *at = &s->places[AT];
    const char *end, *begin = fe_line_begin(at->source, at->line, &end);
    const char *stop = fe_text_at(at, &end), *start = begin;
    while (start < end && (*start == ' ' || *start == '\t'))
        start++;
    s->places[LINE] = *at;
    s->places[LINE].column = (uint32_t)(start - begin) + 1;
    for (const char *c = start; c + 1 < stop; c++)
        s->after_colon = s->after_colon || (*c == ':' && (c[1] == ' ' || c[1] == '\t'));
}

static bool holds(const fault *s, const struct rule *rule)
{
    bool later = s->places[LINE].column < s->places[AT].column;
    const bool conditions[] = {[ALWAYS] = true,
                               [LATER_IN_LINE] = later,
                               [AFTER_COLON] = s->after_colon,
                               [TIGHT_COLON] = s->places[COLON].column > 0};
    return strstr(s->context, rule->context) && strstr(s->problem, rule->problem) &&
           (!*rule->characters || strchr(rule->characters, s->c)) && conditions[rule->when];
}

static void explain_bracket(const fault *s, ff_report *report)
{
    const ff_place *at = &s->places[AT], *begin = &s->places[BEGIN];
    if (s->c == '\n' || s->c == '#')
        ff_error(report, FF_FAULT_INPUT, *begin, NULL, "the \"%c\" opened here is not closed",
                 s->opening);
    else if (at->line > begin->line && s->c != ']' && s->c != '}')
        ff_error(report, FF_FAULT_INPUT, *begin, NULL,
                 "the \"%c\" opened here is not closed, or a \",\" is missing before line %u",
                 s->opening, at->line);
    else
        ff_error(report, FF_FAULT_INPUT, *at, NULL, "expected \",\" or \"%c\" here",
                 s->opening == '[' ? ']' : '}');
}

void fe_yaml_explain(const yaml_parser_t *parser, const ff_source *source, ff_report *report)
{
    fault s = {.problem = parser->problem ? parser->problem : "unknown problem",
               .context = parser->context ? parser->context : "",
               .places[AT] = place_at(source, &parser->problem_mark),
               .places[BEGIN] = place_at(source, &parser->context_mark)};
    s.c = char_at(&s.places[AT]);
    s.opening = char_at(&s.places[BEGIN]);
    s.places[COLON] = find_tight_colon(s.places[BEGIN]);
    look_at_line(&s);
    if (strstr(s.context, "flow") && strstr(s.problem, "did not find expected ','")) {
        explain_bracket(&s, report);
        return;
    }
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        const struct rule *rule = &rules[i];
        if (!holds(&s, rule))
            continue;
        char name[] = {'"', s.c, '"', '\0'};
        bool named = rule->text[strlen(rule->text) - 1] == ' ';
        ff_error(report, FF_FAULT_INPUT, s.places[rule->where], rule->hint, "%s%s", rule->text,
                 named ? name : "");
        return;
    }
    ff_error(report, FF_FAULT_INPUT, s.places[AT], NULL, "this is not valid YAML: %s %s", s.problem,
             s.context);
}
