/* SPDX-License-Identifier: MIT */
/*
 * libflankfilm: the engine of flankfilm as a library. It reads a pipeline from a YAML file, loads
 * the models that the file names, connects and runs them, and returns their results:
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
 * Side effects: the library never prints, exits or forks. It never changes the locale, the working
 * directory, the floating-point environment or the signal handlers of the process. All its state
 * belongs to an engine; only the locks of serial models are global. A model is third-party code in
 * the same process: if a model crashes, the process crashes.
 *
 * Numbers are coherent SI with angles in rad; texts are UTF-8. A struct that the caller fills in
 * begins with `size` if later versions may extend it. A struct that the library fills in is
 * extended at its end.
 *
 * Errors: a function that can fail returns a status, FF_OK or one of plugin.h:
 *   FF_INVALID   the file, an assignment or an argument is wrong, or a model was not found. Wrong
 *                arguments include an object of another engine, and NULL unless the function
 *                allows it;
 *   FF_BUG       a plugin is at fault;
 *   FF_NOCONV    the run failed: no convergence, no solution, or an untrustworthy result;
 *   FF_STOPPED   an observer stopped the run;
 *   FF_NOMEM     out of memory. If the message names a model, that model ran out of memory, and
 *                the objects can be used as after FF_NOCONV. Otherwise the objects of the call can
 *                only be closed. docs/library.md lists how the libraries of shipped models react
 *                to missing memory; FFTW, for example, aborts.
 * ff_engine_message returns the reason.
 *
 * Ownership: the caller closes each object that it created, and closes the engine last. Arguments
 * are copied unless the function says "borrowed". Returned data are constant and belong to the
 * object that returned them. They are valid until that object is closed or used for another run.
 *
 * Threads: one thread at a time uses an engine with its runs and instances. Engines in different
 * threads work in parallel; models that do not support this (FF_SERIAL) are locked across engines.
 * After a fork in a single-threaded process, both processes may continue to use their engines.
 *
 * Version: the part above "Draft" keeps its meaning until the soname libflankfilm.so.0 changes. New
 * members are added at the end of structs.
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

/* The engine holds the loaded models and the messages of the last call. */

typedef struct ff_engine ff_engine;

typedef struct ff_engine_options {
    size_t size;
    const char *const *plugin_paths; /* directories searched first */
    size_t plugin_path_count;
} ff_engine_options;

/*
 * Creates an engine; options may be NULL. Models are searched in this order: `plugin_paths`, the
 * directories in the environment variable FLANKFILM_PLUGIN_PATH, the user's directory
 * (~/.local/share/flankfilm/plugins), the directory installed with the library, and the build
 * tree's directory if the library lies in its build tree. The first file with the id is used;
 * opening a run or an instance warns of further files with the same id. On FF_NOMEM, *engine is
 * NULL.
 */
ff_status ff_engine_new(const ff_engine_options *options, ff_engine **engine);
void ff_engine_close(ff_engine *engine); /* accepts NULL */

/* The errors and warnings of the last call to the engine, its runs and its instances. Each message
   is "FILE:LINE:COLUMN: error: SENTENCE", the line with a caret, and a hint. The result is "" if
   there are none; it is valid until the next of these calls. */
const char *ff_engine_message(const ff_engine *engine);

/* A run takes one case of a pipeline from its file to its results. */

typedef struct ff_run ff_run;
typedef struct ff_stage ff_stage;
typedef struct ff_pipeline ff_pipeline;

/*
 * Reads the file, applies the assignments of `sets`, loads the models that the requested outputs
 * need, and connects them. `sets` is NULL or NULL-terminated: {"film.cells=512", NULL}. All errors
 * are reported together; after an error *run is NULL. A file with a study, an accuracy or an open
 * model (KIND/auto) is refused; only the program `flankfilm run` handles these.
 */
ff_status ff_run_open(ff_engine *engine, const char *file, const char *const *sets, ff_run **run);
void ff_run_close(ff_run *run); /* accepts NULL */

/*
 * ff_run_open in separate steps. First call ff_run_read for a file, or ff_run_parse for a text in
 * memory. Then call ff_run_set for each setting; a later setting overrides an earlier one. Last,
 * ff_run_ready loads and connects the models, and reports all errors of the file and the settings.
 *
 * In ff_run_parse, messages print `name`, and relative paths start at `directory`. After a step
 * that failed, the run only supports reading its messages and closing. *run is NULL on FF_NOMEM or
 * if an argument is missing.
 */
ff_status ff_run_read(ff_engine *engine, const char *file, ff_run **run);
ff_status ff_run_parse(ff_engine *engine, const char *name, const char *directory, const char *text,
                       ff_run **run);
/* Applies an assignment such as "film.cells=512". A path starts at a stage, unless its first word
   is a top-level key of a file. "include=FILE" merges a file over the present values. A run that is
   ready accepts no more assignments, but its copy does. */
ff_status ff_run_set(ff_run *run, const char *assignment);
ff_status ff_run_ready(ff_run *run);
/* Copies what was read and set so far, without messages, into a new run. The copy must be closed
   before the original. */
ff_status ff_run_copy(const ff_run *run, ff_run **copy);

/* Functions called during ff_run_start; any member may be NULL. Each must return. */
typedef struct ff_observer {
    size_t size;
    void *ctx; /* first argument of every function below */
    /* fraction: share of the work that is done, 0 to 1. Return 1 to stop the run, 2 to stop this
       stage and the stages that depend on it, 0 to continue. */
    int32_t (*progress)(void *ctx, const ff_stage *stage, double fraction);
    /* level: FF_LOG_INFO, FF_LOG_WARNING. */
    void (*log)(void *ctx, const ff_stage *stage, int32_t level, const char *text);
    /* Draft: may fill in the results of a stage and return true; the stage is then not evaluated.
       `recall` and `keep` are called once for a loop, with its first stage. */
    bool (*recall)(void *ctx, const ff_pipeline *pipeline, ff_stage *stage);
    /* Draft: called after each evaluation, successful or not; for a loop, after its last round. */
    void (*keep)(void *ctx, const ff_pipeline *pipeline, const ff_stage *stage);
} ff_observer;

/* The name of the stage in the file, such as "film". */
const char *ff_stage_name(const ff_stage *stage);

/* Runs the stages that the requested outputs need, each once. `observer` is borrowed for the call
   and may be NULL. After FF_NOCONV and FF_STOPPED, the results of the stages that completed can be
   read, even if their quality is bad. */
ff_status ff_run_start(ff_run *run, const ff_observer *observer);

enum { FF_MAX_RANK = 4 };

typedef struct ff_result {
    const ff_port *row; /* the model's output row: name, unit, doc */
    const double *data; /* row-major, `count` numbers; NULL: no result */
    uint32_t rank;      /* 0: a scalar */
    size_t shape[FF_MAX_RANK];
    const char *dims[FF_MAX_RANK]; /* "t", "x" */
    size_t count;                  /* product of shape; 1 for a scalar */
    /* Draft: */
    bool wanted;        /* requested, or needed by another stage */
    uint32_t requested; /* position among the outputs that the file requests, from 1; 0: not
                           requested */
    bool required;      /* requested by name, or needed by a required input: it must be given */
    bool refused;       /* the model cannot give it for these inputs */
} ff_result;

/* Finds the result "stage.output". FF_INVALID: the output does not exist or was not computed; the
   message says why. After FF_OK the message is unchanged. */
ff_status ff_run_result(ff_run *run, const char *path, const ff_result **result);
/* Enumerates the computed results, in the order of the run, with the names of their stages.
   FF_INVALID: `index` is beyond the last result. */
ff_status ff_run_output(const ff_run *run, size_t index, const char **stage,
                        const ff_result **result);

typedef struct ff_quality {
    const char *stage; /* name of the stage */
    const char *name;
    double value, limit;
    int32_t verdict;      /* FF_GOOD, FF_DOUBTFUL, FF_BAD */
    const char *text;     /* or NULL */
    bool range;           /* FF_RANGE: doubtful because the model is used outside its range */
    const char *accepted; /* the file's reason for accepting the doubt, which then counts as
                             good; or NULL */
} ff_quality;

/* ff_run_verdict gives the worst verdict of the stages that ran. It is FF_BAD if the run failed;
   FF_INVALID is returned before the run. ff_run_quality gives the quality lines in the order of the
   run; FF_INVALID: `index` is beyond the last line. */
ff_status ff_run_verdict(const ff_run *run, int32_t *verdict);
ff_status ff_run_quality(const ff_run *run, size_t index, const ff_quality **line);

/*
 * An instance is one model used directly, without a file.
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
 * Parameters are checked like those of a file. Setting a parameter checks its name, unit, limits
 * and count. The first run or service creates the model, and this checks the groups and the
 * required parameters. If a parameter is set or an input is connected later, the model and its
 * services are destroyed. The next run or service creates the model again, together with the models
 * that use it.
 *
 * Besides the statuses above, a call can return a status of the model: FF_DOMAIN if the model
 * warned, FF_UNSUPPORTED if it does not support the request. A failed call leaves the instance
 * unchanged except for its results.
 */

typedef struct ff_instance ff_instance;

/* After an error *instance is NULL. */
ff_status ff_instance_new(ff_engine *engine, const char *id, ff_instance **instance);
/* Accepts NULL. Instances that use this one can afterwards only be closed. */
void ff_instance_close(ff_instance *instance);

/* Sets a parameter from text as a user writes it in a file: "3 mm", "auto", "[1, 2]". NULL unsets
   it. Setting one member of a group unsets the others. */
ff_status ff_instance_set(ff_instance *instance, const char *param, const char *text);
/* Sets a parameter from numbers in SI: a scalar is a list of one, a switch is 0 or 1, a choice is
   the rank of its word. */
ff_status ff_instance_set_reals(ff_instance *instance, const char *param, const double *si,
                                size_t count);

/* Feeds an input, "contact.time", with a copy of an array; NULL disconnects it. The engine does not
   check that the numbers are finite; those in a pipeline are. */
ff_status ff_instance_give(ff_instance *instance, const char *input, const ff_array *array);
/* Feeds the inputs "wire.*" with outputs of another instance, or the service input `wire` with its
   service; NULL disconnects them. */
ff_status ff_instance_use(ff_instance *instance, const char *wire, ff_instance *from);
/* Feeds a service input with a table of functions, which is borrowed until it is replaced or the
   instance is closed; NULL disconnects the input. */
ff_status ff_instance_serve(ff_instance *instance, const char *wire, const void *table);

/* Creates the model if it does not exist. A run or a service does this first. */
ff_status ff_instance_ready(ff_instance *instance);
/* Runs the instance, after those instances that feed it and are not up to date; these compute only
   the outputs used here. `outputs` lists the wanted outputs, "h_min p_max"; NULL: all outputs
   except those that the model refuses for its inputs. FF_OK does not mean that the result can be
   trusted: see ff_instance_verdict. */
ff_status ff_instance_run(ff_instance *instance, const char *outputs);

/* Finds an output of the last run. Later changes of the instances that feed this one do not affect
   it. FF_INVALID: the output does not exist or is not available, and the message says why: the
   instance has not run, the run failed, the run did not compute this output, or a parameter or an
   input has changed since. After FF_OK the message is unchanged. The result is valid until the
   instance runs again, also on behalf of another instance, or is closed. */
ff_status ff_instance_result(const ff_instance *instance, const char *output,
                             const ff_result **result);
/* ff_instance_verdict gives the worst verdict of the last run. It is FF_BAD if the run failed;
   FF_INVALID is returned if there was no run. ff_instance_quality gives the quality lines;
   FF_INVALID: `index` is beyond the last line. */
ff_status ff_instance_verdict(const ff_instance *instance, int32_t *verdict);
ff_status ff_instance_quality(const ff_instance *instance, size_t index, const ff_quality **line);

/* Gives the function table of the service with this interface id, such as "flankfilm.viscosity/1".
   The table is valid until the model is destroyed. */
ff_status ff_instance_service(ff_instance *instance, const char *interface, const void **table);
/* Calls work(ctx), which calls the service. Errors inside `work`, and a returned status other
   than FF_OK, are reported as errors of the model. `action` names the activity in messages: "its
   fit". */
ff_status ff_instance_call(ff_instance *instance, const char *action, ff_status (*work)(void *ctx),
                           void *ctx);

/* Lets the next run of `to` start from the final state of the last run of `from`, as in a chain of
   cases. FF_UNSUPPORTED: there is no such state. */
ff_status ff_instance_carry(ff_instance *to, ff_instance *from);

/* Sets the observer of progress and log for all later calls; NULL: none. */
ff_status ff_instance_observe(ff_instance *instance, const ff_observer *observer);

/* ff_instance_reason says why the last call failed or warned; if the model gave a reason, it is the
   model's text alone. ff_instance_item names the parameter, input or output at fault, or is "" if
   it is not known. Both are valid until the next call. */
const char *ff_instance_reason(const ff_instance *instance);
const char *ff_instance_item(const ff_instance *instance);

/*
 * Draft: all that follows may change until version 1.0 of the library. The program `flankfilm`
 * needs it beyond the part above. These functions may only be called inside ff_protected, and their
 * objects must be freed there.
 */

/* Calls function(ctx). If memory runs out, the call is abandoned, the memory that it allocated is
   freed, and the result is FF_NOMEM; otherwise the result is FF_OK. Calls may nest. A callback that
   a plugin calls works in a nested call: missing memory then does not skip code of the plugin, and
   is not reported as its error. */
ff_status ff_protected(void (*function)(void *ctx), void *ctx);

/* Frees memory that the header says the caller frees. Accepts NULL. */
void ff_free(void *memory);

/* Messages: errors and warnings, each with its place in a source. */

/* The cause of an error, from mildest to worst. A program can use the number as its exit code. */
enum {
    FF_FAULT_NONE = 0,
    FF_FAULT_RUN = 1,   /* the run failed numerically */
    FF_FAULT_INPUT = 2, /* the input is wrong */
    FF_FAULT_PLUGIN = 3 /* a plugin is at fault */
};

/* A text from which values were read: a file or a command-line assignment. */
typedef struct ff_source {
    char *name; /* name in messages: "gear.yaml", "--set" */
    char *text; /* the whole text, NUL-terminated */
    size_t length;
    char *directory; /* base of relative paths in this source */
    bool temporary;  /* may be freed before the reports that mention it, so these keep a copy */
} ff_source;

/* A range of characters in one line. line 0: the whole source; source NULL: no place. */
typedef struct ff_place {
    const ff_source *source;
    uint32_t line, column; /* from 1; column counts characters, not bytes */
    uint32_t width;        /* number of characters to underline; 0: only the caret */
} ff_place;

#ifdef __cplusplus
#define FF_NOWHERE ff_place()
#else
#define FF_NOWHERE ((ff_place){0})
#endif

typedef enum ff_severity { FF_ERROR, FF_WARNING } ff_severity;

typedef struct ff_message {
    ff_severity severity;
    int fault; /* for errors: FF_FAULT_INPUT, ... */
    ff_place place;
    char *text;  /* one sentence */
    char *hint;  /* what to do about it, or NULL; if it begins with '\n' it has several lines */
    bool beyond; /* error: a number is outside the limits of its row */
} ff_message;

/* A growing list of messages for one thread. An equal message at the same place is kept once.
   Beyond 1000 messages, errors are counted but not kept. A source must outlive the report unless it
   is `temporary`. */
typedef struct ff_report ff_report;

ff_report *ff_report_new(void);
void ff_report_free(ff_report *report);

/* Adds a message; hint may be NULL. ff_error always returns false, to allow `return
   ff_error(...)`. */
bool ff_error(ff_report *report, int fault, ff_place place, const char *hint, const char *format,
              ...) FF_FORMAT(5, 6);
void ff_warn(ff_report *report, ff_place place, const char *format, ...) FF_FORMAT(3, 4);

/* Copies all messages of another report. */
void ff_report_append(ff_report *report, const ff_report *other);

size_t ff_report_count(const ff_report *report);
const ff_message *ff_report_at(const ff_report *report, size_t index);
const ff_message *ff_report_first(const ff_report *report); /* the first error; NULL if none */
size_t ff_report_errors(const ff_report *report);

/* The worst fault of the errors; FF_FAULT_NONE if there are none. */
int ff_report_fault(const ff_report *report);

/* Prints each message as "file:line:column: error: text", followed by the line, a caret and the
   hint. Messages are sorted by file and line; at most 20 errors are printed. `colour` adds terminal
   colours. The caller frees the text. */
char *ff_report_text(const ff_report *report, bool colour);

/* Writes "load.csv:3:7: the text", without the unknown parts of the place. */
void ff_message_print(const ff_message *message, char *out, size_t size);

/* The candidate nearest to `word` by edit distance, or NULL when none is near. */
const char *ff_nearest(const char *word, const char *const *candidates, size_t count);

/* Copies a text made by a plugin or a file. Control bytes and invalid UTF-8 become '?', white space
   becomes a blank. */
void ff_clean_text(char *out, size_t size, const char *text);

/*
 * Units and quantities. The base dimensions are m, kg, s, K and rad. Angle is a dimension of its
 * own, so that rpm is never taken for Hz. Any thread may call these functions.
 */

enum { FF_DIMENSIONS = 5 };

/* SI value = factor * number + offset; offset is non-zero only for degC and degF. */
typedef struct ff_unit {
    int8_t power[FF_DIMENSIONS]; /* exponents of m, kg, s, K, rad */
    double factor;
    double offset;
} ff_unit;

/* Reads a unit such as "mm", "N m", "Nm", "1/GPa", "mPa s", "N/(mm um)", "kg/m3", "rev/min". "" and
   "1" are dimensionless. On failure returns false and writes into `why` a clause that completes
   'the unit "x" ...'. */
bool ff_unit_parse(const char *text, ff_unit *unit, char *why, size_t why_size);

bool ff_unit_same_dimension(const ff_unit *a, const ff_unit *b);
bool ff_unit_is_si(const ff_unit *unit);            /* factor 1, offset 0 */
bool ff_unit_is_dimensionless(const ff_unit *unit); /* all powers 0 */

double ff_unit_to_si(const ff_unit *unit, double number);
double ff_unit_from_si(const ff_unit *unit, double si);

/* A few units of the same dimension, for messages: "m, mm, um, nm"; "" for a dimension without a
   name. */
const char *ff_unit_examples(const ff_unit *unit);

/* Reads a quantity such as "250 N m", "3mm", "20 deg", "1e-3" and gives its SI value. `row` is the
   unit in which the parameter is declared; messages print it as `row_text`. A number without a unit
   is accepted only if `row` is dimensionless. NaN, infinities and overflow are refused. On failure
   returns false and writes one sentence into `why`. */
bool ff_quantity_parse(const char *text, const ff_unit *row, const char *row_text, double *si,
                       char *why, size_t why_size);

/* A value with the tolerance of a drawing, such as "119.664 mm +- 20 um", "80 degC +- 10 K" or "220
   N m +- 5 %" (also "+/-"). "-75 um to -45 um" stands for the middle of this range. The numbers are
   in `unit`. */
typedef struct ff_tolerance {
    double middle, low, high;
    char unit[64];
} ff_tolerance;

/* Returns 1 if the text has a tolerance, 0 if it has none, and -1 if the tolerance makes no sense;
   a sentence in `why` then gives the reason. */
int ff_tolerance_parse(const char *text, ff_tolerance *tolerance, char *why, size_t why_size);

/* Writes `si` in the row's unit with 6 significant digits, "250 N m". */
void ff_quantity_print(double si, const ff_unit *row, const char *row_text, char *out, size_t size);

/* Reads a whole number that fits into int64_t; on failure returns false, with a sentence in
   `why`. */
bool ff_integer_parse(const char *text, int64_t *value, char *why, size_t why_size);

/* Reads a finite number, independent of the locale, and sets *end behind it. Returns false if there
   is none. */
bool ff_number_parse(const char *text, double *value, const char **end);

/*
 * A YAML file as a tree of maps, sequences and scalars. Scalars stay text until they are read as a
 * type. Each node and each key has its place in the source.
 */

typedef enum ff_node_kind { FF_SCALAR, FF_SEQUENCE, FF_MAP } ff_node_kind;

typedef struct ff_node ff_node;

struct ff_node {
    ff_node_kind kind;
    ff_place place;
    char *text;    /* scalar only; "" if empty */
    bool quoted;   /* scalar only: written in quotes */
    uint32_t rank; /* layer: included files are lowest, then the file itself, then each --set;
                      the higher layer wins */
    const ff_node *replaced; /* the node that this one overrides, from a lower layer; NULL: none */
    size_t count;            /* number of children of a sequence or map */
    ff_node **items;
    char **keys;          /* map only */
    ff_place *key_places; /* map only */
};

/* The allowed top-level keys of a file: "format", "title", ...; NULL-terminated. */
const char *const *ff_file_keys(void);

/* NULL: the key is absent, or `map` is not a map */
const ff_node *ff_node_get(const ff_node *map, const char *key);

/* Resolves `path` relative to `directory`. The caller frees the result. */
char *ff_path_beside(const char *directory, const char *path);

/* Tables of numbers from text files; flankfilm/table.h defines the format. */

/* Reads a table and reports all errors, up to 20. Returns NULL if there was one. Free the table
   with ff_columns_free. */
const ff_table *ff_columns_read(const char *path, const ff_param *rows, size_t count, size_t stride,
                                ff_report *report);
void ff_columns_free(const ff_table *table); /* accepts NULL */

/* The place of a field. SIZE_MAX as `row` or `column` stands for all rows or columns. */
ff_place ff_columns_place(const ff_table *table, size_t row, size_t column);

/* A field in a line of a table of texts, without its quotes and surrounding blanks. */
typedef struct ff_field {
    const char *at, *end;
    uint32_t column, width; /* position in the line, in characters, including the quotes */
    bool quoted;
    bool open; /* its opening quote has no closing quote */
} ff_field;

/* Splits a line that has no line break at its end. Returns its number of fields; only the first
   `most` are stored. `separator` is the separator of the table's header; '\0': the whole line is
   one field. */
size_t ff_fields_split(const char *begin, const char *end, char separator, size_t most,
                       ff_field *fields);
/* Returns the separator of a header: semicolon, comma or tab; '\0' if the header is one field. */
char ff_fields_separator(const char *begin, const char *end);
/* Copies the text of the field, at most end - at + 1 bytes. In a quoted field a doubled quote
   becomes one quote. Returns the length. */
size_t ff_field_copy(const ff_field *field, char *out);

/* Models. Each model is loaded once, checked completely, and never unloaded. */

/* The dimensions of a port row, parsed from its `dims`. */
typedef struct ff_dims {
    uint32_t rank;       /* including the optional dimension */
    bool first_optional; /* true for "engagement? station" */
    char name[FF_MAX_RANK][24];
} ff_dims;

/* A checked model, with the units and dimensions of its rows. The descriptor and its rows have all
   members of this version, even if the plugin was compiled for an older version. */
typedef struct ff_loaded {
    const ff_model *model;
    char *path;     /* path of the shared object */
    uint64_t build; /* hash of the bytes of the shared object */
    ff_unit *param_units;
    ff_dims *input_dims;
    ff_dims *output_dims;
    char *displaced;                   /* unused files with the same id, "a.so, b.so"; NULL: none */
    const struct fe_object_file *file; /* internal to the engine */
} ff_loaded;

/*
 * Returns the model `id`; the first call loads it. Returns NULL after an error: the model was not
 * found, its file is not a shared object, or its ABI or a table is wrong. The fault of a missing
 * model is FF_FAULT_INPUT if the id looks misspelt, otherwise FF_FAULT_PLUGIN. `place` is where the
 * user wrote the id.
 */
const ff_loaded *ff_engine_model(ff_engine *engine, const char *id, ff_place place,
                                 ff_report *report);

/* Warns of each loaded model for which other files with the same id exist. */
void ff_engine_warn_displaced(const ff_engine *engine, ff_report *report);

/* Returns a loaded model whose file was overwritten in place, so that its mapped code has changed;
   NULL: none. Replacing the file by a new one is harmless. */
const ff_loaded *ff_engine_written_over(const ff_engine *engine);

/* The sorted ids of all models on the search path. No model is loaded. */
const char *const *ff_engine_ids(ff_engine *engine, size_t *count);

/* The path of the first file with this name in the plugin directories, or NULL. The caller frees
   it. */
char *ff_engine_file(const ff_engine *engine, const char *name);

/*
 * Reads `node` by the type of `row` into *value, in SI. A number outside the physical limits is an
 * error, outside the calibrated range a warning. `name` ("gears.module") begins each message;
 * `unit` is the row's. The text and reals of *value belong to it. On failure returns false, with
 * errors in the report.
 */
bool ff_param_read(const ff_param *row, const ff_unit *unit, const char *name, const ff_node *node,
                   ff_value *value, ff_report *report);

/* Reads the row's preset in the same way. */
bool ff_param_read_preset(const ff_param *row, const ff_unit *unit, const char *name,
                          ff_value *value, ff_report *report);

void ff_value_clear(ff_value *value);

/* Writes what the row expects: 'a number with a unit such as "3 mm"'. */
void ff_param_expectation(const ff_param *row, char *out, size_t size);

/*
 * A pipeline: the stages of one YAML file, their parameters, wires and results.
 *
 * Evaluation starts at the requested outputs and goes back to what they need; each stage is
 * evaluated once. A stage that no requested output needs is neither loaded nor run.
 */

/* A parameter of a stage and its value. */
typedef struct ff_bound {
    const ff_param *row;
    bool present;               /* given by the user or preset */
    ff_value value;             /* in SI; points into memory of the stage */
    ff_place place;             /* where it was given; source NULL: it is the model's preset */
    const struct ff_wire *wire; /* connected wire that replaces the parameter; NULL: none */
} ff_bound;

/* A wire of a stage: the connection from another stage to the input rows "wire.*" or "wire". */
typedef struct ff_wire {
    char name[48];
    int stage;      /* index of the feeding stage; -1: not connected */
    bool automatic; /* connected automatically, not written in the file */
    bool feedback;  /* its inputs may close a loop */
    bool closes;    /* it closes a loop: it carries the results of the round before */
    ff_place place;
} ff_wire;

/* Stages connected in a cycle by feedback wires. They form one node of the graph: either all of
   them are needed or none, and they are evaluated in rounds until the values on the feedback wires
   have converged. Loops that share a stage are merged. */
typedef struct ff_loop {
    size_t first, count; /* range of its stages in the `order` of the pipeline */
} ff_loop;

/* The settings for iterating loops, from the key `feedback` of the file. */
typedef struct ff_feedback {
    int64_t rounds;    /* maximum number of rounds; a loop that needs more is bad */
    double tolerance;  /* largest change on a wire between rounds, relative to the largest number
                          on it */
    double relaxation; /* share of the change that the next round applies; 1: all of it */
} ff_feedback;

struct ff_stage {
    char *name;
    ff_place place;
    const char *use; /* model id as written */
    ff_place use_place;
    const ff_node *node;
    const ff_loaded *loaded; /* NULL: not loaded */
    bool needed;             /* some requested output needs it */
    char *why;               /* reason, for `explain`: "film.h_min is requested", "feeds film",
                                "no requested output needs it" */
    ff_bound *params;        /* one per row of the model; NULL until bound */
    ff_wire *wires;
    size_t wire_count;
    ff_result *results; /* one per output row */
    bool unread;        /* set before the run: nobody reads the model's estimates of its errors */
    bool ran;
    bool reused;      /* its results come from an earlier run */
    ff_status status; /* status returned by evaluate */
    double seconds;   /* wall time of evaluate in s; of the earlier run if reused */
    double work;      /* processor time of evaluate, summed over its threads, in s */
    ff_quality *quality;
    size_t quality_count;
    const ff_node *accept; /* {STAGE.LINE: reason} of the file if it names the stage; or NULL */
    void *state;           /* in a chain: state before evaluate, then state after it; NULL: none */
    size_t state_size;     /* size of `state` in bytes */
    const ff_loop *loop;   /* loop that contains this stage; NULL: none */
    struct fe_instance *instance; /* internal to the engine */
};

struct ff_pipeline {
    char *title; /* or NULL */
    ff_stage *stages;
    size_t count;
    size_t *order; /* indices of stages in order of evaluation: feeding stages come first */
    ff_loop *loops;
    size_t loop_count;
    ff_feedback feedback;
    bool chained; /* stages start from `state` and leave a new one */
    struct fe_pipeline_memory *memory;
};

/* A run as the program uses it. The report has the messages of all steps; a caller can add
   messages, which count as errors of the file. All three functions return NULL if the run has run
   out of memory once. */
ff_report *ff_run_report(ff_run *run);
const ff_node *ff_run_root(const ff_run *run);   /* the file merged with its settings; NULL: not
                                                    read */
ff_pipeline *ff_run_pipeline(const ff_run *run); /* NULL: not built */

/* Like ff_run_set, with the places where a file has the path and the value; NULL: both places are
   in the assignment. */
ff_status ff_run_set_at(ff_run *run, const char *assignment, const ff_place *path,
                        const ff_place *value);
/* Stores a copy of a node, with its places, under a top-level key of the file. */
ff_status ff_run_put(ff_run *run, const char *key, const ff_node *node);

/* Like ff_run_ready, but ignores the keys of the program, such as `study`. `everything` also loads
   and creates the stages that no output needs, as `check` does. The pipeline may exist for display
   even after errors. */
ff_status ff_run_build(ff_run *run, bool everything);

/*
 * Continues with other parameter values: assignments "stage.parameter=value". The result is the
 * same as for a run read with these values. A model instance is reused if its values are unchanged,
 * it has no connected service and it hands on no state (`carry`); all others are created again.
 *
 * FF_UNSUPPORTED: an assignment causes a message, does not set a plain value, or sets a parameter
 * that had no value before. The run can then only be closed; a new run with these values gives the
 * message.
 *
 * If `objects` is false, all model instances are destroyed and none is created; the pipeline then
 * only provides its parameters and wires, and no model checks the values.
 */
ff_status ff_run_change(ff_run *run, const char *const *assignments, size_t count, bool objects);

/* The stage of a path "stage.name"; NULL: it does not exist. *name is the part behind the dot, or
   "". */
ff_stage *ff_stage_of(const ff_pipeline *pipeline, const char *path, const char **name);
/* The result that feeds input row `input`; NULL: not connected, or a service input. */
ff_result *ff_feeding_result(const ff_pipeline *pipeline, const ff_stage *stage, size_t input);
/* Writes the value of a present parameter as a user writes it: "[50, 50]", "3 mm", "auto". */
void ff_bound_print(const ff_stage *stage, size_t param, char *out, size_t size);
/* Writes the origin of a value: "pair.yaml:12", "--set", "preset". */
void ff_bound_origin(const ff_bound *bound, char *out, size_t size);
/* True if the stage runs and hands a state to the next case of a chain. */
bool ff_stage_has_state(const ff_stage *stage);
/* Replaces the state of the stage by a copy of `bytes`. */
void ff_stage_set_state(ff_stage *stage, const void *bytes, size_t size);
const char *ff_verdict_name(int verdict); /* "good", "doubtful", "bad" */

/* Allocates an output, zeroed. `rank` and `shape` must fit its row. */
double *ff_result_fill(ff_stage *stage, size_t output, uint32_t rank, const size_t *shape);
void ff_add_quality(ff_stage *stage, const char *name, double value, double limit, int verdict,
                    const char *text);
void ff_drop_quality(ff_stage *stage, size_t line);
/* The verdict that the model gave, which may be FF_RANGE, before the file's `accept`. */
int ff_quality_given(const ff_quality *line);

/* The parameter rows of the key `feedback`. */
const ff_param *ff_feedback_rows(size_t *count);

/* All messages of the last call of the instance. ff_instance_stage gives its model, parameters and
   times as a stage of a pipeline. */
const ff_report *ff_instance_report(const ff_instance *instance);
const ff_stage *ff_instance_stage(const ff_instance *instance);

/* Allocates zeroed numbers between guard zones, into which a model writes. NULL: out of memory. */
double *ff_guarded_new(size_t count);
/* Names the guard zone that was overwritten: "before" or "behind"; NULL: none. */
const char *ff_guarded_breach(const double *numbers, size_t count);
void ff_guarded_free(const double *numbers, size_t count);

/* Hooks that observe the calls of an instance; no function may be NULL. */
typedef struct ff_hooks {
    size_t size;
    void *ctx; /* first argument of every function below */
    /* Called after create, before parameters are written. Returns NULL to continue. Otherwise the
       instance fails with the returned clause, which completes 'the plugin ...'. */
    const char *(*created)(void *ctx, void *self);
    /* Called after each call into the model, before the environment (see ff_environment) is
       restored. explained: the model gave a reason for its status. */
    void (*returned)(void *ctx, const char *action, ff_status status, bool explained);
} ff_hooks;

/* Installs hooks. Call it before any other call of the instance; `hooks` is borrowed until the
   instance is closed. */
void ff_instance_watch(ff_instance *instance, const ff_hooks *hooks);

/* For `flankfilm verify`, which calls models directly, and for crash handlers. */

/* The plugin whose code is running in this thread, for crash handlers. The mark is thread-local: a
   thread started by a plugin has none, and the thread that waits for it has the plugin's mark. */
typedef struct ff_guard_mark {
    const char *path;   /* path of the shared object; NULL: no plugin is running */
    const char *stage;  /* or NULL */
    const char *action; /* "evaluate" or another call */
    const void *code;   /* an address in the object; NULL: unknown */
    const struct ff_guard_mark **services; /* marks of the services it may call; NULL-terminated,
                                              or NULL */
    const ff_loaded *loaded;               /* NULL: it is being loaded */
} ff_guard_mark;

ff_guard_mark ff_guard_current(void); /* async-signal-safe */

/* Returns the mark, or the mark of a service it may call, whose file was overwritten in place (see
   ff_engine_written_over); NULL: none. Async-signal-safe. */
const ff_guard_mark *ff_guard_written_over(const ff_guard_mark *mark);

/* The mark as text, to be read by another process: the running plugin and its action; both are ""
   if no plugin is running. */
typedef struct ff_guard_mirror {
    /* "film: the plugin film.so, or one that serves it (oil: the plugin oil.so)," */
    char who[1500];
    char action[64];
} ff_guard_mirror;

/* From now on the mark of this thread is also copied to `mirror`, which is borrowed; NULL: stop
   copying. */
void ff_guard_mirror_set(ff_guard_mirror *mirror);

/* The floating-point environment and the locale, which a plugin must not change.
   ff_environment_keep saves them as they are now. Freed by ff_free. */
typedef struct ff_environment ff_environment;

ff_environment *ff_environment_keep(void);
/* Restores what was changed. Returns a clause that names the change and completes 'the plugin ...';
   NULL if nothing was changed. */
const char *ff_environment_restore(const ff_environment *environment);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#ifdef __cplusplus
}
#endif
#endif
