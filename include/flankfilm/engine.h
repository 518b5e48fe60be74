/* SPDX-License-Identifier: MIT */
/*
 * libflankfilm: the engine of flankfilm as a library. It reads a pipeline from a YAML file, loads
 * the models that it names, wires and runs them, and hands out their results:
 *
 *   ff_engine *engine = NULL;
 *   ff_run *run = NULL;
 *   const ff_result *film;
 *   if (ff_engine_new(NULL, &engine) == FF_OK &&
 *       ff_run_open(engine, "gears.yaml", NULL, &run) == FF_OK &&
 *       ff_run_start(run, NULL) == FF_OK &&
 *       ff_run_result(run, "film.h_min", &film) == FF_OK)
 *       printf("%g %s\n", film->data[0], film->row->unit);
 *   else
 *       fputs(engine ? ff_engine_message(engine) : "out of memory", stderr);
 *   ff_run_close(run);
 *   ff_engine_close(engine);
 *
 * Compile and link with `pkg-config --cflags --libs libflankfilm`. docs/library.md is the guide.
 *
 * Manners: it never prints, exits, forks or changes the locale, the working directory, the
 * floating-point environment or the signal handlers of its process. All that it keeps belongs to an
 * engine, but for the locks of serial models. A model is code of others in this process: one that
 * crashes takes the process along.
 *
 * Numbers are coherent SI with angles in rad; texts are UTF-8. Growing structs that a caller fills
 * in begin with `size`; those that the library fills in grow at their end.
 *
 * Errors: a function that can fail returns a status, FF_OK or one of plugin.h:
 *   FF_INVALID   the file, an assignment or an argument is wrong (NULL where that is not said to be
 *                allowed, an object of another engine), or a model is not there;
 *   FF_BUG       a plugin is at fault;
 *   FF_NOCONV    the run failed: no convergence, no solution, a result that cannot be trusted;
 *   FF_STOPPED   an observer stopped the run;
 *   FF_NOMEM     out of memory; the objects that took part can only be closed. Where the message
 *                names a model, that lacked it, and they can be used as after FF_NOCONV. What
 *                libraries of shipped models do without memory, FFTW's abort among it, stands in
 *                docs/library.md.
 * ff_engine_message says why.
 *
 * Ownership: who makes an object closes it, what was made from an engine before the engine. What is
 * handed in is copied, unless it is said to be borrowed. What is handed out is constant, belongs to
 * the object that it was asked of, and lives until that is closed or works again.
 *
 * Threads: an engine, its runs and its instances are used by one thread at a time. Engines in
 * different threads work at the same time; models that cannot do that (FF_SERIAL) wait for each
 * other. After fork in a process of one thread both processes may go on.
 *
 * Version: the part up to "Draft" keeps its meaning until the name of the library changes from
 * libflankfilm.so.0; what is added, is added at the end of structs.
 */
#ifndef FLANKFILM_ENGINE_H
#define FLANKFILM_ENGINE_H

#include <flankfilm/rows.h>
#include <flankfilm/table.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#define FF_FORMAT(text, first) __attribute__((format(printf, text, first)))
#else
#define FF_FORMAT(text, first)
#endif

/* The engine: the models that were loaded, and the message of the last call. */

typedef struct ff_engine ff_engine;

typedef struct ff_engine_options {
    size_t size;
    const char *const *plugin_paths; /* directories that are searched before all others */
    size_t plugin_path_count;
} ff_engine_options;

/*
 * options may be NULL. Models are looked for in the given directories, in those of the environment
 * variable FLANKFILM_PLUGIN_PATH, in the user's (~/.local/share/flankfilm/plugins), in the one that
 * was installed with the library and, when that lies in its build tree, in the build's. The first
 * file found is the one used; what opens a run or an instance warns of others of its id. Without
 * memory *engine is NULL.
 */
ff_status ff_engine_new(const ff_engine_options *options, ff_engine **engine);
void ff_engine_close(ff_engine *engine); /* NULL is nothing */

/* The errors and warnings of the last call of the engine, its runs and its instances, each as
   "FILE:LINE:COLUMN: error: SENTENCE", the line with a caret, and a hint; "" without any. Lives
   until the next of these calls. */
const char *ff_engine_message(const ff_engine *engine);

/* Runs: one case of a pipeline from its file to its results. */

typedef struct ff_run ff_run;
typedef struct ff_stage ff_stage;
typedef struct ff_pipeline ff_pipeline;

/*
 * Reads the file, applies the assignments of `sets` ("film.cells=512", NULL-terminated, or NULL for
 * none), loads the models that the requested outputs need and wires them. All that is wrong is said
 * at once. *run is NULL after an error. A file with a study, an accuracy or a model that is left
 * open (KIND/auto) is refused: these are the work of the program `flankfilm run`.
 */
ff_status ff_run_open(ff_engine *engine, const char *file, const char *const *sets, ff_run **run);
void ff_run_close(ff_run *run); /* NULL is nothing */

/*
 * The same in steps: the file is read, or its text is taken from memory, where `name` serves
 * messages and relative files lie beside `directory`; settings follow, a later one over those
 * before; ff_run_ready loads and wires, and says all that is wrong with the file and the settings.
 * A step that fails leaves a run that can only be asked for its messages and closed; *run is NULL
 * without memory or arguments.
 */
ff_status ff_run_read(ff_engine *engine, const char *file, ff_run **run);
ff_status ff_run_parse(ff_engine *engine, const char *name, const char *directory, const char *text,
                       ff_run **run);
/* "film.cells=512". A path starts among the stages unless its first word may stand at the top of a
   file; "include=FILE" lays a file over what is there. Once the run is ready it can be set no more:
   a copy can. */
ff_status ff_run_set(ff_run *run, const char *assignment);
ff_status ff_run_ready(ff_run *run);
/* What was read and set so far, without its messages, as a run of its own that is closed before the
   first. */
ff_status ff_run_copy(const ff_run *run, ff_run **copy);

/* Called during ff_run_start; any member may be NULL. A call must return. */
typedef struct ff_observer {
    size_t size;
    void *ctx; /* first argument of every function below */
    /* Share of the work that is done, 0 to 1; 1 stops the run, 2 this stage and those behind it. */
    int32_t (*progress)(void *ctx, const ff_stage *stage, double fraction);
    /* level: FF_LOG_INFO, FF_LOG_WARNING. */
    void (*log)(void *ctx, const ff_stage *stage, int32_t level, const char *text);
    /* Draft: may fill in the results of a stage (true), which is then not evaluated. The first
       stage of a loop stands for all of its stages, here and in keep. */
    bool (*recall)(void *ctx, const ff_pipeline *pipeline, ff_stage *stage);
    /* Draft: called after each evaluation, good or not; of a loop, after the last round. */
    void (*keep)(void *ctx, const ff_pipeline *pipeline, const ff_stage *stage);
} ff_observer;

/* The name of the stage in the file: "film". */
const char *ff_stage_name(const ff_stage *stage);

/* Runs the stages that the requested outputs need, each once. The observer is borrowed for the call
   and may be NULL. After FF_NOCONV and FF_STOPPED the results of the stages that ended well can be
   read, also where their quality is bad. */
ff_status ff_run_start(ff_run *run, const ff_observer *observer);

enum { FF_MAX_RANK = 4 };

typedef struct ff_result {
    const ff_port *row; /* of the model: name, unit, doc */
    const double *data; /* row-major, `count` numbers; NULL: not given */
    uint32_t rank;      /* 0: a scalar */
    size_t shape[FF_MAX_RANK];
    const char *dims[FF_MAX_RANK]; /* "t", "x" */
    size_t count;                  /* product of shape; 1 for a scalar */
    /* Draft: */
    bool wanted;        /* requested, or needed by another stage */
    uint32_t requested; /* by the file: its place among the outputs asked for, from 1; 0: not */
    bool required;      /* must be given: requested by name, or for a required input */
    bool refused;       /* by the model, for these inputs */
} ff_result;

/* The result "stage.output". FF_INVALID: there is no such output, or it was not computed, and the
   message says why. An answer leaves the message as it was. */
ff_status ff_run_result(ff_run *run, const char *path, const ff_result **result);
/* The results that were computed, in the order of the run, and the names of their stages;
   FF_INVALID beyond the last. */
ff_status ff_run_output(const ff_run *run, size_t index, const char **stage,
                        const ff_result **result);

typedef struct ff_quality {
    const char *stage; /* its name */
    const char *name;
    double value, limit;
    int32_t verdict;      /* FF_GOOD, FF_DOUBTFUL, FF_BAD */
    const char *text;     /* or NULL */
    bool range;           /* doubtful, since the model is used outside of its range: FF_RANGE */
    const char *accepted; /* why the file accepts the doubt, which is good then; or NULL */
} ff_quality;

/* The worst verdict of the stages that ran, FF_BAD when the run failed, FF_INVALID before it; and
   their quality lines, in the order of the run, FF_INVALID beyond the last. */
ff_status ff_run_verdict(const ff_run *run, int32_t *verdict);
ff_status ff_run_quality(const ff_run *run, size_t index, const ff_quality **line);

/*
 * Instances: one model by hand, without a file.
 *
 *   ff_instance *gear;
 *   const ff_result *ratio;
 *   ff_instance_new(engine, "gear/involute-spur", &gear);
 *   ff_instance_set(gear, "module", "3 mm");
 *   ...
 *   if (ff_instance_run(gear, "contact_ratio") == FF_OK &&
 *       ff_instance_result(gear, "contact_ratio", &ratio) == FF_OK)
 *       printf("%g\n", ratio->data[0]);
 *   ff_instance_close(gear);
 *
 * Parameters are checked as those of a file: names, units, limits and counts when they are set,
 * groups and what is required when the model is made, which the first run or service does. Setting
 * a parameter, or connecting an input, after that ends the model and its services; the next run or
 * service makes it anew, and with it those that use it. Beside the statuses above, a call answers
 * with that of the model: FF_DOMAIN where it warned, FF_UNSUPPORTED where it does not serve the
 * request. After an error the instance is as before the call, but for its results.
 */

typedef struct ff_instance ff_instance;

/* *instance is NULL after an error. */
ff_status ff_instance_new(ff_engine *engine, const char *id, ff_instance **instance);
/* NULL is nothing. What uses the instance can then only be closed. */
void ff_instance_close(ff_instance *instance);

/* A parameter as a user writes it in a file: "3 mm", "auto", "[1, 2]"; NULL: as if never set. Of a
   group the member that was set last is given. */
ff_status ff_instance_set(ff_instance *instance, const char *param, const char *text);
/* The same in SI: a scalar is a list of one, a switch 0 or 1, a choice the rank of its word. */
ff_status ff_instance_set_reals(ff_instance *instance, const char *param, const double *si,
                                size_t count);

/* Feeds an input, "contact.time", with a copy of an array; NULL: with nothing. In a pipeline its
   numbers are finite. */
ff_status ff_instance_give(ff_instance *instance, const char *input, const ff_array *array);
/* Feeds the inputs "wire.*" with outputs of another instance, or the service input `wire` with its
   service; NULL: with nothing. */
ff_status ff_instance_use(ff_instance *instance, const char *wire, ff_instance *from);
/* Feeds a service input with a table of the caller, which is borrowed until another one replaces it
   or the instance is closed; NULL: with nothing. */
ff_status ff_instance_serve(ff_instance *instance, const char *wire, const void *table);

/* Makes the model, unless it is there: what a run or a service does first. */
ff_status ff_instance_ready(ff_instance *instance);
/* Runs what feeds the instance and is not up to date, for what it takes from there alone, then the
   instance. `outputs` names what is wanted, "h_min p_max"; NULL: all outputs but those that the
   model refuses for its inputs. A result that cannot be trusted is FF_OK: see the verdict. */
ff_status ff_instance_run(ff_instance *instance, const char *outputs);

/* An output of the last run, whatever has since become of what feeds the instance. FF_INVALID:
   there is no such output, or it is not there, and the message says why: the instance has not run,
   the run failed or was not asked for it, or a parameter or an input has changed since. An answer
   leaves the message as it was. It lives until the instance runs again, also for another instance,
   or is closed. */
ff_status ff_instance_result(const ff_instance *instance, const char *output,
                             const ff_result **result);
/* The worst verdict of the last run, FF_BAD when it failed, FF_INVALID without one; and its quality
   lines, FF_INVALID beyond the last. */
ff_status ff_instance_verdict(const ff_instance *instance, int32_t *verdict);
ff_status ff_instance_quality(const ff_instance *instance, size_t index, const ff_quality **line);

/* The table of the service of that interface id, "flankfilm.viscosity/1". It lives until the model
   ends. */
ff_status ff_instance_service(ff_instance *instance, const char *interface, const void **table);
/* Calls work(ctx), which calls the service. What goes wrong in there is said to be the model's, as
   is a status other than FF_OK; `action` says in messages what is being done: "its fit". */
ff_status ff_instance_call(ff_instance *instance, const char *action, ff_status (*work)(void *ctx),
                           void *ctx);

/* Lets the next run of `to` start from the state that the last run of `from` left, as in a chain of
   cases. FF_UNSUPPORTED: there is none. */
ff_status ff_instance_carry(ff_instance *to, ff_instance *from);

/* Progress and log of all calls that follow; NULL: none. */
ff_status ff_instance_observe(ff_instance *instance, const ff_observer *observer);

/* Why the last call failed or warned, in the words of the model alone where it said anything, and
   the parameter, input or output at fault; "" where that is not known. Live until the next call. */
const char *ff_instance_reason(const ff_instance *instance);
const char *ff_instance_item(const ff_instance *instance);

/*
 * Draft: all that follows may change until version 1.0 of the library. It is what the program
 * `flankfilm` needs beyond the above. Its functions are called from ff_protected alone, and their
 * objects are freed there.
 */

/* Calls function(ctx). Without memory the call is left, what was made in it and not freed goes, and
   the answer is FF_NOMEM; else it is FF_OK. Calls may nest: what a plugin calls does its work in
   one, so that the plugin is not left, nor blamed for what goes wrong in there. */
ff_status ff_protected(void (*function)(void *ctx), void *ctx);

/* Frees what is said to be freed by the caller. NULL is nothing. */
void ff_free(void *memory);

/* Messages: errors and warnings, each with the place it is about. */

/* What an error says is at fault, the worst last. A program can use the number as its exit code. */
enum {
    FF_FAULT_NONE = 0,
    FF_FAULT_RUN = 1,   /* the run failed numerically */
    FF_FAULT_INPUT = 2, /* the input is wrong */
    FF_FAULT_PLUGIN = 3 /* a plugin is at fault */
};

/* A text that values were read from: a file or a command-line assignment. */
typedef struct ff_source {
    char *name; /* as messages print it: "gear.yaml", "--set" */
    char *text; /* the whole text, NUL at its end */
    size_t length;
    char *directory; /* where relative files of this source are looked for */
    bool temporary;  /* reports that mention it keep a copy, since it may be freed before them */
} ff_source;

/* A stretch of one line. line 0: the whole source; source NULL: no place at all. */
typedef struct ff_place {
    const ff_source *source;
    uint32_t line, column; /* from 1; column counts characters, not bytes */
    uint32_t width;        /* characters to underline; 0: only the caret */
} ff_place;

#ifdef __cplusplus
#define FF_NOWHERE ff_place()
#else
#define FF_NOWHERE ((ff_place){0})
#endif

typedef enum ff_severity { FF_ERROR, FF_WARNING } ff_severity;

typedef struct ff_message {
    ff_severity severity;
    int fault; /* of an error: FF_FAULT_INPUT, ... */
    ff_place place;
    char *text;  /* one sentence */
    char *hint;  /* what to do about it, or NULL; of several lines when it begins with a line end */
    bool beyond; /* an error says that a number is beyond the limits of its row */
} ff_message;

/* A growing list of messages. Equal messages at the same place are kept once; beyond 1000, errors
   are counted but not kept. Sources outlive it, unless they are temporary. One thread. */
typedef struct ff_report ff_report;

ff_report *ff_report_new(void);
void ff_report_free(ff_report *report);

/* hint may be NULL. Always returns false, so that `return ff_error(...)` reads well. */
bool ff_error(ff_report *report, int fault, ff_place place, const char *hint, const char *format,
              ...) FF_FORMAT(5, 6);
void ff_warn(ff_report *report, ff_place place, const char *format, ...) FF_FORMAT(3, 4);

/* Copies all messages of another report. */
void ff_report_append(ff_report *report, const ff_report *other);

size_t ff_report_count(const ff_report *report);
const ff_message *ff_report_at(const ff_report *report, size_t index);
const ff_message *ff_report_first(const ff_report *report); /* error; NULL without */
size_t ff_report_errors(const ff_report *report);

/* The worst that the errors say is at fault; FF_FAULT_NONE without errors. */
int ff_report_fault(const ff_report *report);

/* Each message as "file:line:column: error: text", the line, a caret and the hint, in the order of
   files and lines, at most 20 errors; with the colours of a terminal when `colour`. Freed by the
   caller. */
char *ff_report_text(const ff_report *report, bool colour);

/* Writes "load.csv:3:7: the text", with the parts of the place that are known. */
void ff_message_print(const ff_message *message, char *out, size_t size);

/* The candidate nearest to `word` by edit distance, or NULL when none is near. */
const char *ff_nearest(const char *word, const char *const *candidates, size_t count);

/* Copies a text that a plugin or a file made; control bytes and broken UTF-8 become '?', white
   space becomes a blank. */
void ff_clean_text(char *out, size_t size, const char *text);

/*
 * Units and quantities. The base dimensions are m, kg, s, K and rad: angle is a dimension of its
 * own, so rpm is never silently Hz. These functions may be called by any thread.
 */

enum { FF_DIMENSIONS = 5 };

/* SI value = factor * number + offset. offset is not 0 for degC and degF alone. */
typedef struct ff_unit {
    int8_t power[FF_DIMENSIONS]; /* of m, kg, s, K, rad */
    double factor;
    double offset;
} ff_unit;

/* Reads "mm", "N m", "Nm", "1/GPa", "mPa s", "N/(mm um)", "kg/m3", "rev/min". "" and "1" are
   dimensionless. On failure writes a clause that completes 'the unit "x" ...' into why (size
   why_size) and returns false. */
bool ff_unit_parse(const char *text, ff_unit *unit, char *why, size_t why_size);

bool ff_unit_same_dimension(const ff_unit *a, const ff_unit *b);
bool ff_unit_is_si(const ff_unit *unit);            /* factor 1, offset 0 */
bool ff_unit_is_dimensionless(const ff_unit *unit); /* all powers 0 */

double ff_unit_to_si(const ff_unit *unit, double number);
double ff_unit_from_si(const ff_unit *unit, double si);

/* A few units of the same dimension that a message can offer: "m, mm, um, nm"; "" for a dimension
   without a name. */
const char *ff_unit_examples(const ff_unit *unit);

/* Reads a quantity such as "250 N m", "3mm", "20 deg", "1e-3" and gives its SI value. `row` is the
   unit that the parameter is declared in; its text `row_text` serves messages. A bare number is
   right only where `row` is dimensionless. NaN, infinities and overflow are refused. On failure
   writes one sentence into why and returns false. */
bool ff_quantity_parse(const char *text, const ff_unit *row, const char *row_text, double *si,
                       char *why, size_t why_size);

/* A value with the tolerance of a drawing: "119.664 mm +- 20 um", "80 degC +- 10 K", "220 N m +- 5
   %" (also +/-), or "-75 um to -45 um", which stands for its middle. Numbers are in `unit`. */
typedef struct ff_tolerance {
    double middle, low, high;
    char unit[64];
} ff_tolerance;

/* 1: the text has a tolerance; 0: it has none; -1: it has, which makes no sense, and a sentence in
   why says so. */
int ff_tolerance_parse(const char *text, ff_tolerance *tolerance, char *why, size_t why_size);

/* Writes `si` in the row's unit as a user would read it, "250 N m" (6 significant digits). */
void ff_quantity_print(double si, const ff_unit *row, const char *row_text, char *out, size_t size);

/* Reads a whole number that fits; on failure false, with a sentence in why. */
bool ff_integer_parse(const char *text, int64_t *value, char *why, size_t why_size);

/* Reads a plain finite number, locale-independent; *end is set past it. False: none there. */
bool ff_number_parse(const char *text, double *value, const char **end);

/*
 * A YAML file as a tree of maps, sequences and scalars. Scalars stay text: the reader of a value
 * declares its type. Every node and key knows its place.
 */

typedef enum ff_node_kind { FF_SCALAR, FF_SEQUENCE, FF_MAP } ff_node_kind;

typedef struct ff_node ff_node;

struct ff_node {
    ff_node_kind kind;
    ff_place place;
    char *text;    /* scalar; "" when empty */
    bool quoted;   /* scalar written in quotes */
    uint32_t rank; /* layer: included files first, the file itself, then each --set; higher wins */
    const ff_node *replaced; /* what an earlier layer had in its place; NULL: nothing */
    size_t count;            /* children of a sequence or map */
    ff_node **items;
    char **keys;          /* map */
    ff_place *key_places; /* map */
};

/* The words that may stand at the top of a file: "format", "title", ...; NULL-terminated. */
const char *const *ff_file_keys(void);

const ff_node *ff_node_get(const ff_node *map, const char *key); /* NULL: absent or no map */

/* The path of a file that a text in that directory names; the caller frees it. */
char *ff_path_beside(const char *directory, const char *path);

/* Tables of numbers from text files; flankfilm/table.h describes the format. */

/* Reports everything that is wrong, up to 20 errors; NULL after one. Freed by ff_columns_free. */
const ff_table *ff_columns_read(const char *path, const ff_param *rows, size_t count, size_t stride,
                                ff_report *report);
void ff_columns_free(const ff_table *table); /* NULL is nothing */

/* The place of a field; a row or column of SIZE_MAX stands for all of them. */
ff_place ff_columns_place(const ff_table *table, size_t row, size_t column);

/* A field of a line of a table that has texts, without its quotes and the blanks around it. */
typedef struct ff_field {
    const char *at, *end;
    uint32_t column, width; /* where it stands in the line, in characters, with its quotes */
    bool quoted;
    bool open; /* it begins with a quote that does not end it */
} ff_field;

/* Splits a line, which has no break at its end. Returns how many fields it has; those from `most`
   on are not kept. `separator`: as its header has it; '\0': the line is one field. */
size_t ff_fields_split(const char *begin, const char *end, char separator, size_t most,
                       ff_field *fields);
/* Semicolon, comma or tab, whichever parts the fields of a header; '\0': it is one field. */
char ff_fields_separator(const char *begin, const char *end);
/* Copies the text, in which a quote is written twice where the field has quotes, into at most
   end - at + 1 bytes. Returns its length. */
size_t ff_field_copy(const ff_field *field, char *out);

/* Models. Each is loaded once, checked in full, and never unloaded. */

/* The dimensions of a port row, read from its `dims`. */
typedef struct ff_dims {
    uint32_t rank;       /* with the optional one */
    bool first_optional; /* "engagement? station" */
    char name[FF_MAX_RANK][24];
} ff_dims;

/* A model that passed every check, with the units and dimensions of its rows. The descriptor and
   its rows have all members of this version, also where the plugin was compiled for an older one.
 */
typedef struct ff_loaded {
    const ff_model *model;
    char *path;     /* of the shared object */
    uint64_t build; /* hash of its bytes */
    ff_unit *param_units;
    ff_dims *input_dims;
    ff_dims *output_dims;
    char *displaced; /* other files of that id, "a.so, b.so", which are not used; NULL: none */
    const struct fe_object_file *file; /* the engine's own */
} ff_loaded;

/*
 * Returns the model `id`, which is loaded at the first call. NULL after an error: it was not found
 * (FF_FAULT_INPUT when the id looks like a misspelt one, else FF_FAULT_PLUGIN), is not a shared
 * object, or has a wrong ABI or a bad table. `place` is where the user named it.
 */
const ff_loaded *ff_engine_model(ff_engine *engine, const char *id, ff_place place,
                                 ff_report *report);

/* Warns of each model that was loaded so far while other files have its id, too. */
void ff_engine_warn_displaced(const ff_engine *engine, ff_report *report);

/* A model that was loaded so far whose file has other bytes now, so that its code is no more what
   it was; NULL: there is none. A file that takes the place of another one does no harm. */
const ff_loaded *ff_engine_written_over(const ff_engine *engine);

/* Sorted ids of all models that can be found, without loading one. */
const char *const *ff_engine_ids(ff_engine *engine, size_t *count);

/* The first file of that name in the directories of plugins, freed by the caller, or NULL. */
char *ff_engine_file(const ff_engine *engine, const char *name);

/*
 * Reads `node` by the row's type into *value: SI, inside the physical limits; a warning when
 * outside the calibrated range. `name` ("gears.module") begins each message; unit is the row's.
 * Its text and reals belong to *value. On failure false, with errors in the report.
 */
bool ff_param_read(const ff_param *row, const ff_unit *unit, const char *name, const ff_node *node,
                   ff_value *value, ff_report *report);

/* The same from the row's preset. */
bool ff_param_read_preset(const ff_param *row, const ff_unit *unit, const char *name,
                          ff_value *value, ff_report *report);

void ff_value_clear(ff_value *value);

/* What the row expects: 'a number with a unit such as "3 mm"'. */
void ff_param_expectation(const ff_param *row, char *out, size_t size);

/*
 * A pipeline: the stages of one YAML file, their parameters, their wires, and their results.
 *
 * Evaluation pulls: from the requested outputs back to what they need, each stage once. A stage
 * that no requested output needs is not loaded and not run.
 */

/* A parameter of a stage with the value it has. */
typedef struct ff_bound {
    const ff_param *row;
    bool present;               /* given or preset */
    ff_value value;             /* SI; points into memory of the stage */
    ff_place place;             /* where it was given; source NULL: the model's preset */
    const struct ff_wire *wire; /* connected, so that it replaces the parameter; NULL: none */
} ff_bound;

/* A wire of a stage: the stage that feeds the input rows named "wire.*" or "wire". */
typedef struct ff_wire {
    char name[48];
    int stage;      /* index of the feeding stage; -1: not connected */
    bool automatic; /* not written in the file */
    bool feedback;  /* its inputs may close a loop */
    bool closes;    /* it closes one: it carries what its stage gave in the round before */
    ff_place place;
} ff_wire;

/* Stages that need each other by feedback wires. They are one node of the graph: all of them are
   needed or none, and they are evaluated round after round until what the wires carry has settled.
   Loops that share a stage are one. */
typedef struct ff_loop {
    size_t first, count; /* its stages in the `order` of the pipeline */
} ff_loop;

/* How loops are iterated, as the file says under `feedback`. */
typedef struct ff_feedback {
    int64_t rounds;    /* a loop that has not settled after so many is bad */
    double tolerance;  /* largest change of what a wire carries, over the largest number in it */
    double relaxation; /* share of that change which the next round takes; 1: all of it */
} ff_feedback;

struct ff_stage {
    char *name;
    ff_place place;
    const char *use; /* model id as written */
    ff_place use_place;
    const ff_node *node;
    const ff_loaded *loaded; /* NULL: not loaded */
    bool needed;             /* some requested output needs it */
    char *why;               /* in words, for `explain`: "film.h_min is requested", "feeds film",
                                "no requested output needs it" */
    ff_bound *params;        /* one per row of the model; NULL before bind */
    ff_wire *wires;
    size_t wire_count;
    ff_result *results; /* one per output row */
    bool ran;
    bool reused;      /* its results are those of an earlier run */
    ff_status status; /* of evaluate */
    double seconds;   /* wall time of evaluate, also of the earlier run */
    double work;      /* s: processor time of evaluate, over all threads */
    ff_quality *quality;
    size_t quality_count;
    const ff_node *accept; /* {STAGE.LINE: reason} of the file, if it names the stage; or NULL */
    void *state;         /* in a chain: what evaluate starts from, then what it left; NULL: none */
    size_t state_size;   /* bytes of it */
    const ff_loop *loop; /* that it belongs to; NULL: none */
    struct fe_instance *instance; /* the engine's own */
};

struct ff_pipeline {
    char *title; /* or NULL */
    ff_stage *stages;
    size_t count;
    size_t *order; /* indices of stages; each comes after those that feed it */
    ff_loop *loops;
    size_t loop_count;
    ff_feedback feedback;
    bool chained; /* stages start from `state`, and leave one */
    struct fe_pipeline_memory *memory;
};

/* Runs in the program's hands. Messages of all steps, to which a caller can add its own; they count
   as errors of the file. NULL when the run had no memory once: then so are the next two. */
ff_report *ff_run_report(ff_run *run);
const ff_node *ff_run_root(const ff_run *run);   /* of the file with its settings; NULL: not read */
ff_pipeline *ff_run_pipeline(const ff_run *run); /* NULL: not built */

/* As ff_run_set, with the places where a file says path and value; NULL: they point into the
   assignment. */
ff_status ff_run_set_at(ff_run *run, const char *assignment, const ff_place *path,
                        const ff_place *value);
/* Puts a copy of a node, places and all, under a key of the file. */
ff_status ff_run_put(ff_run *run, const char *key, const ff_node *node);

/* As ff_run_ready, whatever the keys of a program say, such as `study`; with `everything` also the
   stages that no output needs are loaded and made, as `check` wants. The pipeline may be there to
   be shown when there are errors. */
ff_status ff_run_build(ff_run *run, bool everything);

/*
 * Goes on with other values: "stage.parameter=value". An object stays where its values do, unless a
 * service is wired to it or it hands on a state (`carry`); all others are made anew. The run
 * answers as one that was read with these values. FF_UNSUPPORTED: an assignment says something else
 * than a plain value of a parameter that had one, or it is worth a message; then the run can only
 * be closed, and another one says why.
 * Without `objects` there are none afterwards, and none says what it has against the values: the
 * pipeline tells its parameters and wires alone.
 */
ff_status ff_run_change(ff_run *run, const char *const *assignments, size_t count, bool objects);

/* The stage of "stage.name"; NULL: there is none. *name: what stands behind the dot, or "". */
ff_stage *ff_stage_of(const ff_pipeline *pipeline, const char *path, const char **name);
/* The result that feeds input row `input`; NULL: not connected, or a service. */
ff_result *ff_feeding_result(const ff_pipeline *pipeline, const ff_stage *stage, size_t input);
/* Writes the value of a present parameter as a user would: "[50, 50]", "3 mm", "auto". */
void ff_bound_print(const ff_stage *stage, size_t param, char *out, size_t size);
/* Where a value comes from: "pair.yaml:12", "--set", "preset". */
void ff_bound_origin(const ff_bound *bound, char *out, size_t size);
/* True when the stage runs and hands a state to the neighbouring case of a chain. */
bool ff_stage_has_state(const ff_stage *stage);
/* Replaces the state of the stage by a copy. */
void ff_stage_set_state(ff_stage *stage, const void *bytes, size_t size);
const char *ff_verdict_name(int verdict); /* "good", "doubtful", "bad" */

/* Makes room for an output, zeroed: rank and shape are such as its row allows. */
double *ff_result_fill(ff_stage *stage, size_t output, uint32_t rank, const size_t *shape);
void ff_add_quality(ff_stage *stage, const char *name, double value, double limit, int verdict,
                    const char *text);
void ff_drop_quality(ff_stage *stage, size_t line);
/* The verdict that the model gave, FF_RANGE among them, whatever the file accepts. */
int ff_quality_given(const ff_quality *line);

/* The parameters under `feedback`. */
const ff_param *ff_feedback_rows(size_t *count);

/* All messages of the last call of the instance, and its model, parameters and times, as those of a
   stage in a pipeline. */
const ff_report *ff_instance_report(const ff_instance *instance);
const ff_stage *ff_instance_stage(const ff_instance *instance);

/* Numbers between guard zones, zeroed: what a model writes into. NULL: there is no memory. */
double *ff_guarded_new(size_t count);
/* Where somebody has written outside of them: "before", "behind"; NULL: nowhere. */
const char *ff_guarded_breach(const double *numbers, size_t count);
void ff_guarded_free(const double *numbers, size_t count);

/* What watches an instance at work; all functions are there. */
typedef struct ff_hooks {
    size_t size;
    void *ctx; /* first argument of every function below */
    /* After create, before parameters reach the model. NULL, or what ends it: a clause that
       completes 'the plugin ...'. */
    const char *(*created)(void *ctx, void *self);
    /* After each call into the model, before what it must leave alone is set back; explained: it
       said why. */
    void (*returned)(void *ctx, const char *action, ff_status status, bool explained);
} ff_hooks;

/* From the first call of the instance on; borrowed until it is closed. */
void ff_instance_watch(ff_instance *instance, const ff_hooks *hooks);

/* For `flankfilm verify`, which calls a model by itself to see what it does, and for handlers of
   crashes. */

/* Which plugin's code is running, for handlers of crashes. Each thread knows its own: a thread that
   a plugin started knows nothing, and the one that waits for it has the answer. */
typedef struct ff_guard_mark {
    const char *path;                      /* of the shared object; NULL: no plugin runs */
    const char *stage;                     /* or NULL */
    const char *action;                    /* "evaluate" and the like */
    const void *code;                      /* an address in the object; NULL: not known */
    const struct ff_guard_mark **services; /* that it may call; NULL-ended, or NULL */
    const ff_loaded *loaded;               /* NULL: it is being loaded */
} ff_guard_mark;

ff_guard_mark ff_guard_current(void); /* may be called in a handler of signals */

/* As ff_engine_written_over, of the mark or of a service that it may call. May be called in a
   handler of signals. */
const ff_guard_mark *ff_guard_written_over(const ff_guard_mark *mark);

/* The same in words, for another process: who is running, and its action; "" while no plugin is. */
typedef struct ff_guard_mirror {
    char
        who[1500]; /* "film: the plugin film.so, or one that serves it (oil: the plugin oil.so)," */
    char action[64];
} ff_guard_mirror;

/* From now on the mark of this thread is written there, too; NULL: nowhere. Borrowed. */
void ff_guard_mirror_set(ff_guard_mirror *mirror);

/* What a plugin must leave as it was: floating-point arithmetic and the locale, as they are now.
   Freed by ff_free. */
typedef struct ff_environment ff_environment;

ff_environment *ff_environment_keep(void);
/* Sets back what differs and says what it was: a clause that completes 'the plugin ...'; NULL when
   all is as it was. */
const char *ff_environment_restore(const ff_environment *environment);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#ifdef __cplusplus
}
#endif
#endif
