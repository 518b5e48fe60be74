/* SPDX-License-Identifier: MIT */
/* Converts the events of libyaml into nodes, within limits, and refuses parts of YAML that are not
   used. */
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "node.h"
#include "text.h"

/* Anchors are searched linearly, so their number is limited. */
enum { MOST_ANCHORS = 1000, TO_THE_END = 1 << 20 };

typedef struct anchor {
    const char *name;
    const ff_node *node; /* NULL while the node is being read */
} anchor;

typedef struct reader {
    fe_resource open; /* registers the parser and its last event */
    yaml_parser_t parser;
    yaml_event_t event;
    fe_tree *tree;
    const ff_source *source;
    ff_report *report;
    anchor *anchors;
    size_t anchor_count;
    bool stopped; /* the rest cannot be read, and the content so far is lost */
} reader;

/* Returns the place of an event. For a text of several lines this is the part in the first line. */
static ff_place event_place(const reader *r, const yaml_event_t *event)
{
    const yaml_mark_t *start = &event->start_mark, *end = &event->end_mark;
    ff_place place = {.source = r->source,
                      .line = (uint32_t)start->line + 1,
                      .column = (uint32_t)start->column + 1};
    if (event->type == YAML_SCALAR_EVENT || event->type == YAML_ALIAS_EVENT)
        place.width =
            end->line == start->line ? (uint32_t)(end->column - start->column) : TO_THE_END;
    return place;
}

static void fail(reader *r, ff_place place, const char *hint, const char *text)
{
    ff_error(r->report, FF_FAULT_INPUT, place, hint, "%s", text);
}

static void stop(reader *r, ff_place place, const char *hint, const char *text)
{
    fail(r, place, hint, text);
    r->stopped = true;
}

static void copy_text(reader *r, yaml_char_t **text, size_t length)
{
    if (*text)
        *text = (yaml_char_t *)fe_arena_text(&r->tree->arena, (const char *)*text, length);
}

static void copy_word(reader *r, yaml_char_t **word)
{
    copy_text(r, word, *word ? strlen((const char *)*word) : 0);
}

/* Takes the event from the parser; the tree then owns its texts. */
static yaml_event_t take_event(reader *r)
{
    yaml_event_t taken = r->event;
    if (taken.type == YAML_ALIAS_EVENT) {
        copy_word(r, &taken.data.alias.anchor);
    } else if (taken.type == YAML_SCALAR_EVENT || taken.type == YAML_SEQUENCE_START_EVENT ||
               taken.type == YAML_MAPPING_START_EVENT) {
        copy_word(r, &taken.data.scalar.anchor); /* all three event types begin with anchor and
                                                    tag */
        copy_word(r, &taken.data.scalar.tag);
    }
    if (taken.type == YAML_SCALAR_EVENT)
        copy_text(r, &taken.data.scalar.value, taken.data.scalar.length);
    yaml_event_delete(&r->event);
    return taken;
}

/* Reads the next event; false if there is none. */
static bool next(reader *r, yaml_event_t *event)
{
    if (r->stopped)
        return false;
    if (!yaml_parser_parse(&r->parser, &r->event)) {
        if (r->parser.error == YAML_MEMORY_ERROR)
            fe_out_of_memory();
        fe_yaml_explain(&r->parser, r->source, r->report);
        r->stopped = true;
        return false;
    }
    *event = take_event(r);
    if (r->tree->nodes > FE_MOST_NODES)
        stop(r, event_place(r, event), NULL,
             "the input has more than 100000 values, with aliases written out");
    return !r->stopped;
}

/* Returns the text of a scalar event. */
static char *read_text(reader *r, const yaml_event_t *event, ff_place place)
{
    char *text = (char *)event->data.scalar.value;
    if (memchr(text, '\0', event->data.scalar.length))
        fail(r, place, NULL, "the text contains a NUL character");
    return text;
}

static void check_tag(reader *r, const yaml_char_t *tag, ff_place place)
{
    if (tag)
        fail(r, place, "remove it; a text that begins with \"!\" is written in quotes",
             "tags are not used in these files");
}

static const anchor *find_anchor(const reader *r, const char *name)
{
    for (size_t i = r->anchor_count; i-- > 0;)
        if (!strcmp(r->anchors[i].name, name))
            return &r->anchors[i];
    return NULL;
}

/* Returns a copy of the node that the alias names; an empty map if there is no such anchor. */
static ff_node *read_alias(reader *r, const yaml_event_t *event, ff_place place, size_t level)
{
    const char *name = (const char *)event->data.alias.anchor;
    const anchor *a = find_anchor(r, name);
    if (!a)
        ff_error(r->report, FF_FAULT_INPUT, place, "write the anchor before its aliases",
                 "there is no anchor \"&%.60s\" before the alias \"*%.60s\"", name, name);
    else if (!a->node)
        ff_error(r->report, FF_FAULT_INPUT, place, NULL,
                 "the alias \"*%.60s\" is inside the value that it repeats", name);
    else if (level + fe_node_levels(a->node) > FE_MOST_LEVELS + 1)
        stop(r, place, NULL, "values are nested more than 64 levels deep here");
    else
        return fe_node_copy(r->tree, a->node);
    return fe_node_new(r->tree, FF_MAP, place);
}

static ff_node *read_node(reader *r, const yaml_event_t *event, size_t level);

static void read_list(reader *r, ff_node *list, size_t level)
{
    yaml_event_t event;
    while (next(r, &event) && event.type != YAML_SEQUENCE_END_EVENT)
        fe_node_add(r->tree, list, NULL, FF_NOWHERE, read_node(r, &event, level + 1));
}

static void add_pair(reader *r, ff_node *map, char *key, ff_place place, ff_node *item)
{
    size_t at = fe_map_find(map, key);
    if (at < map->count) {
        char *hint = fe_print_text("its first occurrence is in line %u", map->key_places[at].line);
        ff_error(r->report, FF_FAULT_INPUT, place, hint, "the key \"%.60s\" is given twice", key);
        fe_free(hint);
    } else if (map->count == FE_MOST_KEYS)
        stop(r, place, NULL, "the map has more than 4096 keys");
    else if (strchr(key, ':') && fe_node_is_empty(item) && item->place.line == place.line &&
             item->place.column == place.column + place.width)
        /* inside braces, "use:gear" is a key without a value */
        ff_error(r->report, FF_FAULT_INPUT, place, "write \"key: value\"",
                 "a space is missing after \":\" in \"%.60s\"", key);
    else
        fe_node_add(r->tree, map, key, place, item);
}

/* Checks that the value of "<<" is an alias of a map, or a list of such aliases. */
static void check_merge(reader *r, const ff_node *item, bool alias, ff_place place)
{
    bool good = item->kind == FF_SEQUENCE || (alias && item->kind == FF_MAP);
    for (size_t i = 0; i < item->count && item->kind == FF_SEQUENCE; i++)
        good = good && item->items[i]->kind == FF_MAP;
    if (!good)
        fail(r, place, "write \"<<: *name\" or \"<<: [*one, *two]\"",
             "\"<<\" takes aliases of maps only");
}

/* Merges maps into the map. The added keys replace neither the map's own keys nor keys of maps
 * merged earlier. */
static void merge_maps(reader *r, ff_node *map)
{
    size_t at = fe_map_find(map, "<<");
    ff_node *merged = map->items[at];
    fe_map_remove(map, at);
    bool list = merged->kind == FF_SEQUENCE;
    for (size_t i = 0; i < (list ? merged->count : 1); i++) {
        const ff_node *from = list ? merged->items[i] : merged;
        for (size_t k = 0; from->kind == FF_MAP && k < from->count; k++)
            if (fe_map_find(map, from->keys[k]) == map->count)
                add_pair(r, map, from->keys[k], from->key_places[k], from->items[k]);
    }
}

static char *read_key(reader *r, const yaml_event_t *event, ff_place place, bool *merge)
{
    char *key = NULL;
    if (event->type == YAML_SCALAR_EVENT) {
        key = read_text(r, event, place);
        check_tag(r, event->data.scalar.tag, place);
        *merge = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE && !strcmp(key, "<<");
        if (event->data.scalar.length == 0)
            fail(r, place, "write \"key: value\"", "a key is missing before \":\"");
    } else
        stop(r, place, "write the key as a plain word",
             event->type == YAML_ALIAS_EVENT ? "an alias cannot be a key"
                                             : "a list or a map cannot be a key");
    return key;
}

static void read_map(reader *r, ff_node *map, size_t level)
{
    yaml_event_t event;
    bool merge = false, merges = false;
    while (next(r, &event) && event.type != YAML_MAPPING_END_EVENT) {
        ff_place place = event_place(r, &event);
        char *key = read_key(r, &event, place, &merge);
        if (!next(r, &event))
            return;
        bool alias = event.type == YAML_ALIAS_EVENT;
        ff_place item_place = event_place(r, &event);
        ff_node *item = read_node(r, &event, level + 1);
        if (r->stopped)
            return;
        if (merge)
            check_merge(r, item, alias, item_place);
        merges = merges || merge;
        if (*key)
            add_pair(r, map, key, place, item);
    }
    if (merges && !r->stopped)
        merge_maps(r, map);
}

/* Reads a list, a map or a scalar. */
static ff_node *read_content(reader *r, const yaml_event_t *event, ff_place place, size_t level)
{
    static const ff_node_kind kinds[] = {[YAML_SCALAR_EVENT] = FF_SCALAR,
                                         [YAML_SEQUENCE_START_EVENT] = FF_SEQUENCE,
                                         [YAML_MAPPING_START_EVENT] = FF_MAP};
    /* same offset for lists and maps */
    const char *name = (const char *)event->data.scalar.anchor;
    ff_node *node = fe_node_new(r->tree, kinds[event->type], place);
    size_t at = r->anchor_count;
    check_tag(r, event->data.scalar.tag, place);
    if (name && at == MOST_ANCHORS) {
        stop(r, place, NULL, "the file has more than 1000 anchors");
        return node;
    }
    if (name) {
        r->anchors = fe_resize(r->anchors, (at + 1) * sizeof *r->anchors);
        r->anchors[r->anchor_count++] = (anchor){.name = name};
    }
    if (node->kind == FF_MAP)
        read_map(r, node, level);
    else if (node->kind == FF_SEQUENCE)
        read_list(r, node, level);
    else {
        yaml_scalar_style_t style = event->data.scalar.style;
        node->text = read_text(r, event, place);
        node->quoted =
            style == YAML_SINGLE_QUOTED_SCALAR_STYLE || style == YAML_DOUBLE_QUOTED_SCALAR_STYLE;
    }
    if (name)
        r->anchors[at].node = node;
    return node;
}

/* Reads the node that begins with `event`. */
static ff_node *read_node(reader *r, const yaml_event_t *event, size_t level)
{
    ff_place place = event_place(r, event);
    if (level > FE_MOST_LEVELS && event->type != YAML_SCALAR_EVENT) {
        stop(r, place, NULL, "values are nested more than 64 levels deep here");
        return fe_node_new(r->tree, FF_MAP, place);
    }
    return event->type == YAML_ALIAS_EVENT ? read_alias(r, event, place, level)
                                           : read_content(r, event, place, level);
}

static ff_node *read_document(reader *r)
{
    ff_node *root = NULL;
    yaml_event_t event;
    while (next(r, &event)) {
        switch (event.type) {
        case YAML_ALIAS_EVENT:
        case YAML_SCALAR_EVENT:
        case YAML_SEQUENCE_START_EVENT:
        case YAML_MAPPING_START_EVENT:
            root = read_node(r, &event, 1);
            continue;
        case YAML_STREAM_END_EVENT:
            if (!root)
                root =
                    fe_node_new(r->tree, FF_SCALAR, fe_place_of(r->source, r->source->length, 0));
            return root;
        default:
            if (root && event.type == YAML_DOCUMENT_START_EVENT)
                stop(r, event_place(r, &event), "keep one document per file",
                     "a second document begins here; only one is read");
        }
    }
    return NULL;
}

/* Refuses control characters and invalid bytes. libyaml reports these only by offset, and treats
   some of them as line breaks. */
static bool check_characters(const ff_source *source, ff_report *report)
{
    const char *at = source->text, *end = at + source->length;
    uint32_t c;
    for (size_t n; at < end; at += n) {
        n = fe_char_read(at, end, &c);
        bool control = (c < 0x20 && c != '\t' && c != '\n') || (c >= 0x7F && c < 0xA0) ||
                       c == 0x2028 || c == 0x2029 || c == 0xFFFE || c == 0xFFFF;
        if (!control && c != FE_NO_CHAR)
            continue;
        ff_place place = fe_place_of(source, (size_t)(at - source->text), 1);
        if (control)
            return ff_error(report, FF_FAULT_INPUT, place, NULL,
                            "there is a control character (U+%04X) in the text", c);
        return ff_error(report, FF_FAULT_INPUT, place, "save the file as UTF-8",
                        "the text is not UTF-8 here (byte 0x%02X)", (unsigned char)*at);
    }
    return true;
}

static void close_parser(void *reader_of)
{
    reader *r = reader_of;
    yaml_event_delete(&r->event);
    yaml_parser_delete(&r->parser);
}

ff_node *fe_yaml_read(fe_tree *tree, const ff_source *source, const char *text, ff_report *report)
{
    if (!check_characters(source, report))
        return NULL;
    reader *r = fe_alloc(sizeof *r);
    r->tree = tree;
    r->source = source;
    r->report = report;
    if (!yaml_parser_initialize(&r->parser))
        fe_out_of_memory();
    fe_resource_add(&r->open, close_parser, r);
    yaml_parser_set_encoding(&r->parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&r->parser, (const unsigned char *)text, strlen(text));
    ff_node *root = read_document(r);
    fe_resource_remove(&r->open);
    close_parser(r);
    fe_free(r->anchors);
    fe_free(r);
    return root;
}
