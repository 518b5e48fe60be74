/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the events of libyaml to nodes, within bounds, with all that YAML allows and we do not. */
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "node.h"
#include "text.h"

/* Anchors are looked up one after the other. */
enum { MOST_ANCHORS = 1000 };

typedef struct anchor {
    char *name;
    const ff_node *node;
    bool open; /* its node is still being read */
} anchor;

typedef struct reader {
    yaml_parser_t parser;
    ff_tree *tree;
    const ff_source *source;
    uint32_t shift; /* columns before the YAML text in its first line */
    ff_report *report;
    anchor *anchors;
    size_t anchor_count;
    const char *line_at; /* where line `line` begins: events come in the order of the text */
    uint32_t line;
    bool stopped; /* the rest cannot be read */
} reader;

static ff_place mark_place(const reader *r, const yaml_mark_t *mark)
{
    uint32_t shift = mark->line == 0 ? r->shift : 0;
    return (ff_place){.source = r->source,
                      .line = (uint32_t)mark->line + 1,
                      .column = (uint32_t)mark->column + 1 + shift};
}

/* Characters from the place to the end of its line. */
static uint32_t rest_of_line(reader *r, ff_place place)
{
    const char *end = r->source->text + r->source->length;
    uint32_t code, column = 1;
    while (r->line < place.line && r->line_at < end) {
        size_t n = ff_break_at(r->line_at, end);
        r->line += n > 0;
        r->line_at += n > 0 ? n : 1;
    }
    for (const char *at = r->line_at; at < end && !ff_break_at(at, end); column++)
        at += ff_char_read(at, end, &code);
    return column > place.column ? column - place.column : 0;
}

/* The event's place; of a text over several lines, the part in the first one. */
static ff_place event_place(reader *r, const yaml_event_t *event)
{
    const yaml_mark_t *start = &event->start_mark, *stop = &event->end_mark;
    ff_place place = mark_place(r, start);
    bool one_line = stop->line == start->line;
    place.width = one_line ? (uint32_t)(stop->column - start->column) : rest_of_line(r, place);
    return place;
}

static bool fail(reader *r, ff_place place, const char *hint, const char *text)
{
    return ff_error(r->report, FF_EXIT_INPUT, place, hint, "%s", text);
}

static void *stop(reader *r, ff_place place, const char *hint, const char *text)
{
    fail(r, place, hint, text);
    r->stopped = true;
    return NULL;
}

/* The next event, to be deleted; false at the end of what can be read. */
static bool next(reader *r, yaml_event_t *event)
{
    if (r->stopped)
        return false;
    if (yaml_parser_parse(&r->parser, event))
        return true;
    ff_yaml_explain(&r->parser, r->source, r->shift, r->report);
    r->stopped = true;
    return false;
}

static ff_node *make(reader *r, ff_kind kind, ff_place place)
{
    ff_node *node = ff_node_new(r->tree, kind, place);
    if (!node)
        stop(r, place, NULL, "the input has more than 100000 values, with aliases written out");
    return node;
}

static void check_tag(reader *r, const yaml_char_t *tag, ff_place place)
{
    if (tag)
        fail(r, place, "remove it; a text that begins with \"!\" is written in quotes",
             "tags are not used in these files");
}

static void open_anchor(reader *r, const yaml_char_t *name, const ff_node *node)
{
    if (!name || !node)
        return;
    if (r->anchor_count == MOST_ANCHORS) {
        stop(r, node->place, NULL, "the file has more than 1000 anchors");
        return;
    }
    const char *text = (const char *)name;
    r->anchors[r->anchor_count++] = (anchor){
        .name = ff_arena_text(&r->tree->arena, text, strlen(text)), .node = node, .open = true};
}

static void close_anchor(reader *r, const ff_node *node)
{
    for (size_t i = r->anchor_count; i-- > 0;)
        if (r->anchors[i].node == node)
            r->anchors[i].open = false;
}

static const anchor *find_anchor(const reader *r, const char *name)
{
    for (size_t i = r->anchor_count; i-- > 0;)
        if (!strcmp(r->anchors[i].name, name))
            return &r->anchors[i];
    return NULL;
}

static ff_node *read_alias(reader *r, const yaml_event_t *event, size_t level)
{
    const char *name = (const char *)event->data.alias.anchor;
    ff_place place = event_place(r, event);
    const anchor *a = find_anchor(r, name);
    if (!a) {
        ff_error(r->report, FF_EXIT_INPUT, place, "anchors stand before their aliases",
                 "the alias \"*%.60s\" has no anchor \"&%.60s\" before it", name, name);
        return make(r, FF_SCALAR, place);
    }
    if (a->open) {
        ff_error(r->report, FF_EXIT_INPUT, place, NULL,
                 "the alias \"*%.60s\" stands inside the value that it repeats", name);
        return make(r, FF_SCALAR, place);
    }
    if (level + ff_node_levels(a->node) > FF_MOST_LEVELS + 1)
        return stop(r, place, NULL, "values are nested more than 64 levels deep here");
    ff_node *copy = ff_node_copy(r->tree, a->node);
    if (!copy)
        stop(r, place, NULL, "the input has more than 100000 values, with aliases written out");
    return copy;
}

/* The text of a scalar, kept by the tree. */
static char *keep_text(reader *r, const yaml_event_t *event, ff_place place)
{
    const char *text = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    if (memchr(text, '\0', length)) {
        fail(r, place, NULL, "the text has a NUL character in it");
        length = strlen(text);
    }
    return ff_arena_text(&r->tree->arena, text, length);
}

static ff_node *read_scalar(reader *r, const yaml_event_t *event)
{
    ff_place place = event_place(r, event);
    yaml_scalar_style_t style = event->data.scalar.style;
    ff_node *node = make(r, FF_SCALAR, place);
    if (!node)
        return NULL;
    check_tag(r, event->data.scalar.tag, place);
    node->text = keep_text(r, event, place);
    node->quoted =
        style == YAML_SINGLE_QUOTED_SCALAR_STYLE || style == YAML_DOUBLE_QUOTED_SCALAR_STYLE;
    if (event->data.scalar.anchor) {
        open_anchor(r, event->data.scalar.anchor, node);
        close_anchor(r, node);
    }
    return node;
}

static ff_node *read_node(reader *r, yaml_event_t *event, size_t level);

static ff_node *read_list(reader *r, const yaml_event_t *start, size_t level)
{
    ff_node *list = make(r, FF_SEQUENCE, mark_place(r, &start->start_mark));
    yaml_event_t event;
    if (!list)
        return NULL;
    check_tag(r, start->data.sequence_start.tag, list->place);
    open_anchor(r, start->data.sequence_start.anchor, list);
    while (next(r, &event)) {
        if (event.type == YAML_SEQUENCE_END_EVENT) {
            yaml_event_delete(&event);
            close_anchor(r, list);
            return list;
        }
        ff_node *item = read_node(r, &event, level + 1);
        if (item)
            ff_list_add(r->tree, list, item);
    }
    return NULL;
}

/* Reads over the node that `event` begins, without a limit to its depth. */
static void pass_node(reader *r, yaml_event_t *event)
{
    size_t open = 0;
    do {
        yaml_event_type_t type = event->type;
        yaml_event_delete(event);
        open += type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT;
        open -= type == YAML_SEQUENCE_END_EVENT || type == YAML_MAPPING_END_EVENT;
    } while (open > 0 && next(r, event));
}

static char *read_key(reader *r, yaml_event_t *event, ff_place *place, bool *merge)
{
    char *key = NULL;
    *place = event_place(r, event);
    *merge = false;
    if (event->type != YAML_SCALAR_EVENT) {
        bool alias = event->type == YAML_ALIAS_EVENT;
        place->width = alias ? place->width : 0;
        fail(r, *place, "write the key as a plain word",
             alias ? "an alias cannot be a key" : "a list or a map cannot be a key");
        pass_node(r, event);
        return NULL;
    }
    check_tag(r, event->data.scalar.tag, *place);
    if (event->data.scalar.length == 0)
        fail(r, *place, "write \"key: value\"", "a key is missing before \":\"");
    else
        key = keep_text(r, event, *place);
    *merge = key && event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE && !strcmp(key, "<<");
    yaml_event_delete(event);
    return key;
}

static void add_pair(reader *r, ff_node *map, char *key, ff_place place, ff_node *item)
{
    size_t at = ff_map_find(map, key);
    if (at < map->count) {
        char *hint = ff_print_text("it stands first in line %u", map->key_places[at].line);
        ff_error(r->report, FF_EXIT_INPUT, place, hint, "the key \"%.60s\" is given twice", key);
        free(hint);
        return;
    }
    if (map->count == FF_MOST_KEYS) {
        stop(r, place, NULL, "the map has more than 4096 keys");
        return;
    }
    /* in { }, "use:gear" is a key without a value */
    char *colon = strchr(key, ':');
    if (colon && item->kind == FF_SCALAR && !*item->text && item->place.width == 0 &&
        item->place.line == place.line && item->place.column == place.column + place.width) {
        ff_error(r->report, FF_EXIT_INPUT, place, "write \"key: value\"",
                 "a space is missing after \":\" in \"%.60s\"", key);
        return;
    }
    ff_map_add(r->tree, map, key, place, item);
}

/* Keys of the merged maps do not replace the map's own, nor those of earlier merged maps. */
static void merge_into(reader *r, ff_node *map, const ff_node *from)
{
    for (size_t i = 0; i < from->count && !r->stopped; i++)
        if (ff_map_find(map, from->keys[i]) == map->count)
            add_pair(r, map, from->keys[i], from->key_places[i], from->items[i]);
}

/* What may stand behind "<<": an alias of a map, or a list of such aliases. */
static ff_node *read_merge(reader *r, yaml_event_t *event, size_t level)
{
    bool alias = event->type == YAML_ALIAS_EVENT;
    bool list = event->type == YAML_SEQUENCE_START_EVENT;
    size_t errors = ff_report_errors(r->report);
    ff_place place = alias ? event_place(r, event) : mark_place(r, &event->start_mark);
    ff_node *node = read_node(r, event, level);
    if (!node || ff_report_errors(r->report) > errors)
        return NULL;
    bool good = (alias && node->kind == FF_MAP) || list;
    for (size_t i = 0; list && i < node->count; i++)
        good = good && node->items[i]->kind == FF_MAP;
    if (!good)
        fail(r, place, "write \"<<: *name\" or \"<<: [*one, *two]\"",
             "\"<<\" takes aliases of maps only");
    return good ? node : NULL;
}

static ff_node *end_map(reader *r, ff_node *map, const ff_node *merged)
{
    if (merged && merged->kind == FF_MAP)
        merge_into(r, map, merged);
    else
        for (size_t i = 0; merged && i < merged->count; i++)
            merge_into(r, map, merged->items[i]);
    close_anchor(r, map);
    return map;
}

static ff_node *read_map(reader *r, const yaml_event_t *start, size_t level)
{
    ff_node *map = make(r, FF_MAP, mark_place(r, &start->start_mark)), *merged = NULL;
    yaml_event_t event;
    ff_place place;
    bool merge, seen = false;
    if (!map)
        return NULL;
    check_tag(r, start->data.mapping_start.tag, map->place);
    open_anchor(r, start->data.mapping_start.anchor, map);
    while (next(r, &event)) {
        if (event.type == YAML_MAPPING_END_EVENT) {
            yaml_event_delete(&event);
            return end_map(r, map, merged);
        }
        char *key = read_key(r, &event, &place, &merge);
        if (!next(r, &event))
            break;
        if (merge && seen)
            fail(r, place, "give a list: <<: [*one, *two]", "the key \"<<\" is given twice");
        if (merge && !seen) {
            seen = true;
            merged = read_merge(r, &event, level + 1);
            continue;
        }
        ff_node *item = read_node(r, &event, level + 1);
        if (key && item && !merge)
            add_pair(r, map, key, place, item);
    }
    return NULL;
}

/* Reads the node that `event` begins and deletes the event. NULL: it is lost. */
static ff_node *read_node(reader *r, yaml_event_t *event, size_t level)
{
    ff_node *node = NULL;
    yaml_event_t start = *event;
    if (level > FF_MOST_LEVELS && start.type != YAML_SCALAR_EVENT)
        stop(r, mark_place(r, &start.start_mark), NULL,
             "values are nested more than 64 levels deep here");
    else if (start.type == YAML_ALIAS_EVENT)
        node = read_alias(r, &start, level);
    else if (start.type == YAML_SCALAR_EVENT)
        node = read_scalar(r, &start);
    else if (start.type == YAML_SEQUENCE_START_EVENT)
        node = read_list(r, &start, level);
    else if (start.type == YAML_MAPPING_START_EVENT)
        node = read_map(r, &start, level);
    yaml_event_delete(&start);
    return node;
}

/* The first document; what follows it is an error. */
static ff_node *read_stream(reader *r, bool *empty)
{
    ff_node *root = NULL;
    yaml_event_t event;
    size_t documents = 0;
    *empty = false;
    while (next(r, &event)) {
        yaml_event_type_t type = event.type;
        if (type == YAML_STREAM_END_EVENT) {
            yaml_event_delete(&event);
            *empty = documents == 0;
            return root;
        }
        if (type == YAML_DOCUMENT_START_EVENT && ++documents > 1)
            stop(r, mark_place(r, &event.start_mark), "keep one document per file",
                 "a second document begins here; only one is read");
        if (documents == 1 &&
            (type == YAML_ALIAS_EVENT || type == YAML_SCALAR_EVENT ||
             type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT))
            root = read_node(r, &event, 1);
        else
            yaml_event_delete(&event);
    }
    return NULL;
}

/* libyaml counts characters, and knows controls and ill-formed bytes by their byte only. */
static bool check_characters(const ff_source *source, ff_report *report)
{
    const char *at = source->text, *end = at + source->length;
    uint32_t c;
    for (size_t n; at < end; at += n) {
        n = ff_char_read(at, end, &c);
        bool control = (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F ||
                       (c > 0x7F && c < 0xA0 && c != 0x85) || c == 0xFFFE || c == 0xFFFF;
        if (c != FF_NO_CHAR && !control)
            continue;
        ff_place place = ff_place_of(source, (size_t)(at - source->text), 1);
        if (control)
            return ff_error(report, FF_EXIT_INPUT, place, NULL,
                            "there is a control character (U+%04X) in the text", c);
        return ff_error(report, FF_EXIT_INPUT, place, "save the file as UTF-8",
                        "the text is not UTF-8 here (byte 0x%02X)", (unsigned char)*at);
    }
    return true;
}

ff_node *ff_yaml_read(ff_tree *tree, const ff_source *source, size_t start, bool *empty,
                      ff_report *report)
{
    reader r = {
        .tree = tree, .source = source, .report = report, .line_at = source->text, .line = 1};
    ff_node *root = NULL;
    *empty = false;
    if (!check_characters(source, report) || !yaml_parser_initialize(&r.parser))
        return NULL;
    r.shift = ff_place_of(source, start, 0).column - 1;
    r.anchors = ff_alloc(MOST_ANCHORS * sizeof *r.anchors);
    yaml_parser_set_encoding(&r.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&r.parser, (const unsigned char *)source->text + start,
                                 source->length - start);
    root = read_stream(&r, empty);
    yaml_parser_delete(&r.parser);
    free(r.anchors);
    return root;
}
