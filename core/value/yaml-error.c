/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What libyaml stumbled over, in the words of someone who writes a file. */
#include <string.h>
#include <yaml.h>

#include "node.h"
#include "text.h"

typedef struct stumble {
    const char *problem, *context; /* of libyaml; never NULL */
    ff_place at, begin;            /* of the problem; of what was being read */
    ff_report *report;
} stumble;

static ff_place place_at(const ff_source *source, const yaml_mark_t *mark, uint32_t shift)
{
    return (ff_place){.source = source,
                      .line = (uint32_t)mark->line + 1,
                      .column = (uint32_t)mark->column + 1 + (mark->line == 0 ? shift : 0)};
}

static void say(const stumble *s, ff_place place, const char *hint, const char *text)
{
    ff_error(s->report, FF_EXIT_INPUT, place, hint, "%s", text);
}

/* The character at the place, or NUL at the line's end. */
static char char_at(const ff_place *place)
{
    const char *end, *at = ff_text_at(place, &end);
    return at < end ? *at : '\0';
}

/* The place of the first byte of its line that is no blank. */
static ff_place line_start(const ff_place *place)
{
    const char *end, *at = ff_line_begin(place->source, place->line, &end);
    ff_place start = *place;
    start.column = 1;
    for (; at < end && (*at == ' ' || *at == '\t'); at++)
        start.column++;
    return start;
}

/* The first ":" in the line of `place` from `at` on that has no blank behind it. */
static bool find_tight_colon(const ff_place *place, ff_place *colon)
{
    const char *end, *at = ff_text_at(place, &end);
    uint32_t code;
    *colon = *place;
    for (; at < end; colon->column++) {
        if (*at == ':' && at + 1 < end && at[1] != ' ' && at[1] != '\t')
            return true;
        at += ff_char_read(at, end, &code);
    }
    return false;
}

static bool is_first_in_line(const ff_place *place)
{
    return line_start(place).column >= place->column;
}

/* A "key: " stands in the line before the place. */
static bool has_colon_before(const ff_place *place)
{
    const char *end, *stop = ff_text_at(place, &end);
    const char *at = ff_line_begin(place->source, place->line, &end);
    for (; at + 1 < stop; at++)
        if (*at == ':' && (at[1] == ' ' || at[1] == '\t'))
            return true;
    return false;
}

static void say_no_token(const stumble *s)
{
    char c = char_at(&s->at);
    if (c == '\t') {
        say(s, s->at, "indent with spaces", "a tab is used for indentation");
        return;
    }
    ff_error(s->report, FF_EXIT_INPUT, s->at, "put the text in quotes",
             "a value cannot begin with \"%c\"", c ? c : ' ');
}

static void say_extra_colon(const stumble *s)
{
    if (has_colon_before(&s->at))
        say(s, s->at, "put a text that holds \": \" in quotes",
            "there is a second \": \" in this line");
    else
        say(s, line_start(&s->at), "indent it like the other keys of its map",
            "this line is indented deeper than the line above allows");
}

static void say_no_colon(const stumble *s)
{
    ff_place colon;
    if (find_tight_colon(&s->begin, &colon))
        say(s, colon, "write \"key: value\"", "a space is missing after \":\"");
    else
        say(s, s->begin, "write \"key: value\", or \"- value\" for an entry of a list",
            "this line has no \":\" after its key");
}

static void say_no_key(const stumble *s)
{
    char c = char_at(&s->at);
    if (c == ']' || c == '}')
        say(s, s->at, "remove it, or add the bracket that opens", "this bracket closes nothing");
    else if (c == ':')
        say(s, s->at, "write \"key: value\"", "a key is missing before \":\"");
    else if (!is_first_in_line(&s->at))
        say(s, s->at, "quote the whole value; inside '...' an apostrophe is written twice",
            "there is text after the end of the value");
    else if (c == '-')
        say(s, s->at, "indent the list under its key", "a list entry stands where a key should");
    else
        say(s, s->at, "keys of one map begin in the same column",
            "this line's indentation fits none of the lines above");
}

static void say_unclosed(const stumble *s)
{
    bool list = strstr(s->problem, "']'") != NULL;
    char c = char_at(&s->at), open = list ? '[' : '{', close = list ? ']' : '}';
    if (c == '\0' || c == '#')
        ff_error(s->report, FF_EXIT_INPUT, s->begin, NULL, "the \"%c\" opened here is not closed",
                 open);
    else if (s->at.line > s->begin.line && c != ']' && c != '}')
        ff_error(s->report, FF_EXIT_INPUT, s->begin, NULL,
                 "the \"%c\" opened here is not closed, or a \",\" is missing before line %u", open,
                 s->at.line);
    else
        ff_error(s->report, FF_EXIT_INPUT, s->at, NULL, "expected \",\" or \"%c\" here", close);
}

static void say_no_content(const stumble *s)
{
    char c = char_at(&s->at);
    if (c == '\0')
        say(s, s->at, NULL, "a value is missing here");
    else
        ff_error(s->report, FF_EXIT_INPUT, s->at, NULL, "a value is missing before \"%c\"", c);
}

static void say_open_quote(const stumble *s)
{
    say(s, s->begin, NULL, "the quote opened here is not closed");
}

static void say_escape(const stumble *s)
{
    say(s, s->at, "in \"...\" write \"\\\\\" for a backslash, or use '...'",
        "this escape after \"\\\" is not known");
}

static void say_flow_colon(const stumble *s)
{
    say(s, s->at, "write a space after it, or put the text in quotes",
        "a \":\" cannot stand here inside brackets");
}

static void say_tab(const stumble *s)
{
    say(s, s->at, "indent with spaces", "a tab is used for indentation");
}

static void say_entry(const stumble *s)
{
    say(s, s->at, "begin the list in the line below its key",
        "a list entry cannot stand in this place");
}

static void say_no_dash(const stumble *s)
{
    say(s, s->at, "entries of one list begin with \"- \" in the same column",
        "this line is no entry of the list above");
}

static void say_after_end(const stumble *s)
{
    char c = char_at(&s->at);
    if (c == ']' || c == '}')
        say_no_key(s);
    else
        say(s, s->at, NULL, "there is text after the end of the document's value");
}

static void say_name(const stumble *s)
{
    say(s, s->begin, "put a text that begins with \"*\" or \"&\" in quotes",
        "an anchor or alias needs a name of letters and digits");
}

static void say_tag(const stumble *s)
{
    say(s, s->begin, "put a text that begins with \"!\" in quotes",
        "tags are not used in these files");
}

static void say_block(const stumble *s)
{
    say(s, s->at, "begin the text in the next line",
        "nothing may follow \"|\" or \">\" in its line");
}

static void say_directive(const stumble *s)
{
    say(s, s->begin.column ? s->begin : s->at, "remove the line that begins with \"%\"",
        "this directive is not used in these files");
}

static const struct {
    const char *context, *problem; /* parts of libyaml's words */
    void (*say)(const stumble *s);
} phrases[] = {
    {"", "cannot start any token", say_no_token},
    {"", "found a tab character", say_tab},
    {"", "mapping values are not allowed", say_extra_colon},
    {"", "mapping keys are not allowed", say_extra_colon},
    {"", "block sequence entries are not allowed", say_entry},
    {"plain scalar", "found unexpected ':'", say_flow_colon},
    {"simple key", "could not find expected ':'", say_no_colon},
    {"quoted scalar", "unexpected end of stream", say_open_quote},
    {"quoted scalar", "unexpected document indicator", say_open_quote},
    {"quoted scalar", "", say_escape},
    {"block mapping", "did not find expected key", say_no_key},
    {"block collection", "did not find expected '-'", say_no_dash},
    {"flow", "did not find expected ','", say_unclosed},
    {"", "did not find expected node content", say_no_content},
    {"", "did not find expected <document start>", say_after_end},
    {"scanning an a", "", say_name}, /* an anchor, an alias */
    {"block scalar", "", say_block},
    {"tag", "", say_tag},
    {"directive", "", say_directive},
    {"", "tag handle", say_tag},
    {"", "YAML", say_directive},
};

void ff_yaml_explain(const yaml_parser_t *parser, const ff_source *source, uint32_t shift,
                     ff_report *report)
{
    stumble s = {.problem = parser->problem ? parser->problem : "unknown problem",
                 .context = parser->context ? parser->context : "",
                 .at = place_at(source, &parser->problem_mark, shift),
                 .begin = place_at(source, &parser->context_mark, shift),
                 .report = report};
    for (size_t i = 0; i < sizeof phrases / sizeof *phrases; i++)
        if (strstr(s.context, phrases[i].context) && strstr(s.problem, phrases[i].problem)) {
            phrases[i].say(&s);
            return;
        }
    ff_error(report, FF_EXIT_INPUT, s.at, NULL, "this is not valid YAML: %s %s", s.problem,
             s.context);
}
