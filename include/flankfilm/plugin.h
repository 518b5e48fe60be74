/* SPDX-License-Identifier: MIT */
/*
 * The flankfilm plugin interface, major version 1.
 *
 * A plugin is a shared object that exports one function: flankfilm_model_v1(), which returns one
 * constant ff_model, or flankfilm_models_v1(), which returns several. The id of a model is
 * "kind/name"; its file is <plugin dir>/kind/name.so. For further models in the same object, these
 * paths are symbolic links to it. A plugin does not link to flankfilm. It never prints or exits,
 * and it does not change the floating-point environment, the locale or the signal handlers. Compile
 * it with -std=c11 -fPIC -fvisibility=hidden.
 *
 * A struct that later versions may extend begins with `size`, set by the code that fills in the
 * struct. Before reading a member of a later version, test it with FF_HAS. Rows of a table are
 * addressed by the stride in the descriptor. All numbers in the interface are coherent SI with
 * angles in rad, except the limits in an ff_param row: these are in the row's unit, as users read
 * them. Strings are UTF-8, constant, and valid as long as the plugin is loaded. Arrays are
 * row-major, contiguous and never overlap; a count of 0 is always allowed.
 *
 * Threads: one thread at a time uses an instance. Instances of a model may run in parallel unless
 * the model has FF_SERIAL. Service tables are pure: any number of threads may call them.
 */
#ifndef FLANKFILM_PLUGIN_H
#define FLANKFILM_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FF_ABI_MAJOR 1
#define FF_ABI_MINOR 3

/* True if struct *s has `field` in the version that filled it in. */
#define FF_HAS(s, field)                                                                           \
    ((size_t)((const char *)(&(s)->field + 1) - (const char *)(s)) <= (s)->size)

/* A positive status concerns the numbers, a negative one the call. */
typedef int32_t ff_status;
enum {
    FF_OK = 0,
    FF_DOMAIN = 1,   /* values were computed, but outside the range for which the model is made */
    FF_NOCONV = 2,   /* the computation failed: no convergence, no solution */
    FF_STOPPED = 3,  /* stopped because host->progress returned non-zero */
    FF_INVALID = -1, /* a parameter or an input cannot be used */
    FF_NOMEM = -2,   /* memory is missing */
    FF_UNSUPPORTED = -3, /* a legal request that this model does not support */
    FF_BUG = -4          /* an internal invariant of the model is broken */
};

/* The type of a parameter: what a user may write, and which member of ff_value has the value. */
enum {
    FF_REAL = 1, /* real: a number with the row's unit or another of its dimension */
    FF_INT,      /* integer */
    FF_BOOL,     /* integer: true 1, false 0 */
    FF_CHOICE,   /* integer: rank in `choices`, from 0; text: the word */
    FF_TEXT,     /* text */
    FF_REALS,    /* reals, count: a list; a single number is accepted as a list of one */
    FF_FILE,     /* text: a path that can be opened, resolved relative to the YAML file */
    FF_TREE      /* reserved: no row has this type */
};

/* Flags of a parameter row. */
enum {
    FF_REQUIRED = 1,   /* must be given; in a group: one of its members must be given */
    FF_MIN_OPEN = 2,   /* `min` itself is refused */
    FF_MAX_OPEN = 4,   /* `max` itself is refused */
    FF_WHOLE = 8,      /* FF_REALS that must be whole numbers */
    FF_TUNABLE = 16,   /* trades speed for accuracy. A larger FF_INT (cells, steps) or a smaller
                          FF_REAL (tolerance, point distance) is more accurate. The program
                          measures errors by varying it */
    FF_INCREASING = 32 /* FF_REALS that must not decrease */
};

typedef struct ff_param {
    const char *name;    /* "module"; a dot separates nested maps: "atlas.from" */
    const char *unit;    /* "mm", "1/GPa", "1"; "" for a value without a unit, such as text */
    const char *doc;     /* one line: what it is and what it changes */
    int32_t type;        /* FF_REAL ... */
    uint32_t flags;      /* FF_REQUIRED | ... */
    const char *preset;  /* default, as a user writes it: "20 deg"; NULL: none. In a group it
                            applies if no member is given */
    const char *choices; /* "linear|cubic". FF_REAL, FF_INT: words accepted instead of a number.
                            FF_TEXT, since 1.2: examples of accepted texts, "ISO VG 220" */
    const char *group;   /* at most one parameter of a group may be given; NULL: no group */
    double min, max;     /* physical limits: a value outside is an error; used if min < max */
    double low, high;    /* calibrated range: a value outside is a warning; used if low < high */
    uint32_t min_count, max_count; /* FF_REALS: allowed lengths; max_count 0: any */

    /* Since 1.2; 0 and NULL in shorter rows. */
    size_t place; /* 1 + offset of the instance's member that receives the value; 0: none,
                     `set` is called. The macros of author.h check the member's type */
    /* optional input that replaces the parameter: a service, "oil"; since 1.3 also a data input,
       "gear.density", or a wire of data inputs, "gear". If it is connected, the parameter must
       not be given and its preset is ignored; otherwise FF_REQUIRED applies */
    const char *instead;
} ff_param;

/*
 * The engine writes each member that has a `place` once, in SI, after create and before wire. The
 * last column is the member's value if the parameter was not given and has no preset.
 *
 *   FF_REAL              double        NaN
 *   FF_INT               int64_t       -1
 *   FF_BOOL, FF_CHOICE   int32_t       -1
 *   FF_TEXT, FF_FILE     const char *  NULL
 *   FF_REALS             ff_reals      count 0
 *
 * A word instead of a number ("auto") also gives this value. Set `place` to 0 if several words must
 * be distinguished or if -1 is a legal number. Texts and lists belong to the engine and are valid
 * until destroy returns.
 */
typedef struct ff_reals {
    const double *data;
    size_t count;
} ff_reals;

/* Flags of a port row. */
enum {
    FF_OPTIONAL = 1,  /* an input that may stay unconnected */
    FF_FEEDBACK = 2,  /* since 1.2: a data input that may close a loop; never connected
                         automatically */
    FF_DIFFERENCE = 4 /* since 1.3: a data output in K that is a temperature difference: it may
                         be negative, and the shift of degC does not apply to it */
};

/* Since 1.3: the number that represents a series or a field where only one number is shown. */
enum {
    FF_NO_HEADLINE = 0,
    FF_LEAST = 1,   /* minimum, as for a film */
    FF_LARGEST = 2, /* maximum, as for a pressure or a temperature */
    FF_MEAN = 3     /* mean over the row's first dimension, as for a loss */
};

/*
 * A port. A data port is an array of doubles along named dimensions: "" is a scalar, "station" a
 * series, "t x" a field. In "engagement? station" the first dimension may be absent. Equal
 * dimension names mean equal lengths on one wire and among the outputs of one stage; "t" of two
 * wires may differ in length. Since 1.3, "gear.station" means the dimension "station" of the wire
 * `gear`; an input of another wire or an output can use it. The positions "x" of a field "t x" are
 * an output along "x", or along "t x" if the grid moves. A service port is a table of functions,
 * named by its interface id.
 *
 * An input row is named "wire.output". `wire` is the key in the YAML file that names the feeding
 * stage; `output` is the row that the feeding stage must offer. An optional row stays unconnected
 * if the stage does not offer it. A service input is named by its wire alone. A second service of
 * the same wire adds a word of its own, such as the optional "rheology.rate". If the file does not
 * name a wire, it is connected automatically if exactly one stage of the kinds in `from` offers all
 * its required rows. All rows of one wire have the same `from`.
 *
 * All rows of a feedback wire have FF_FEEDBACK and FF_OPTIONAL. A wire can only close a loop if the
 * file names it. The stages of a loop are evaluated in rounds until the values on the feedback
 * wires have converged. In the first round these inputs are absent (data NULL), so that it is the
 * run without feedback.
 */
typedef struct ff_port {
    const char *name;
    const char *unit; /* coherent SI: "m", "N/m", "rad", "1"; "" for a service */
    const char *doc;
    const char *dims;    /* "", "station", "t x" */
    const char *service; /* interface id, "flankfilm.viscosity/1"; NULL: a data port */
    uint32_t flags;
    const char *from; /* kinds that can feed an input: "stiffness|dynamics"; NULL: the kind with
                         the name of the wire */

    /* For data outputs, since 1.3; 0 and NULL in shorter rows. */
    double min, max;   /* natural bounds in the row's unit, which no valid number exceeds; one
                          may be infinite; used if min < max. A number outside makes the run
                          fail. A row in K without FF_DIFFERENCE always has the lower bound 0 */
    const char *label; /* name in words: "least film thickness"; NULL: `name` */
    const char *shown; /* unit for display, "um", of the same dimension as `unit`; NULL: `unit` */
    const char *quantity; /* the physical quantity, whatever the model: "friction coefficient of
                             the mesh". The program compares two stages of a run that give the same
                             quantity; NULL: not compared */
    const char *origin;   /* input row that is the zero point for relative errors and changes:
                             "operating.oil_temperature"; NULL: 0 */
    int32_t headline;     /* FF_LEAST ...; FF_NO_HEADLINE for a scalar */
    double apart;         /* scalar with a `quantity`: allowed difference between two stages that
                             give it, in `unit`. The larger `apart` of the two applies; 0: only
                             rounding errors */
} ff_port;

typedef struct ff_value {
    size_t size;
    double real;
    int64_t integer;
    const char *text; /* FF_TEXT, FF_FILE, FF_CHOICE; for FF_REAL and FF_INT a word written
                         instead */
    const double *reals;
    size_t count;
    int32_t given;    /* 0: preset of the row; 1: given by the user */
    const void *tree; /* reserved: NULL */
} ff_value;           /* strings and arrays are valid during the call only */

typedef struct ff_array {
    const double *data;  /* NULL: not connected */
    const size_t *shape; /* `rank` lengths */
    uint32_t rank;
} ff_array;

/*
 * The verdict of a quality line. A line judges either the numbers (balances, errors, convergence)
 * or whether the model is used inside its range. FF_DOUBTFUL and FF_RANGE are warnings; FF_BAD
 * makes the run fail.
 */
enum {
    FF_GOOD = 0,
    FF_DOUBTFUL = 1, /* the numbers may be inaccurate */
    FF_BAD = 2,      /* the numbers are wrong */
    FF_RANGE = 3     /* since 1.3: the numbers are right, but outside the range of the model */
};

/* Levels of host->log. */
enum { FF_LOG_INFO = 0, FF_LOG_WARNING = 1 };

/* The functions that the engine offers to a model. The host outlives the instance. Any thread that
   works for the instance may call them. */
typedef struct ff_host {
    size_t size;
    uint32_t abi_minor;
    void *ctx; /* first argument of every function below */

    /* Reports an error and returns `status`, to allow `return host->fail(...)`. `item`: the
       parameter, input or output at fault, or NULL. The engine adds file, line and column. */
    ff_status (*fail)(void *ctx, ff_status status, const char *item, const char *text);
    void (*log)(void *ctx, int32_t level, const char *text);

    /* Allocates output row `index`. The memory belongs to the engine and is valid until the next
       evaluate. NULL: out of memory; return FF_NOMEM. Call it once for each output, during
       evaluate. The memory of a wanted output is zeroed. The memory of an unwanted output is NaN if
       abi_minor of the model is 3 or more; the output counts as absent if a NaN is left. */
    double *(*output)(void *ctx, uint32_t index, uint32_t rank, const size_t *shape);

    /* Adds a line to the quality record of the stage: a value, its limit, a verdict (FF_GOOD ...),
       and a sentence or NULL. FF_BAD makes the run fail, but its results are kept. */
    void (*quality)(void *ctx, const char *name, double value, double limit, int32_t verdict,
                    const char *text);

    /* Reports the share of the work that is done, 0 to 1. If the result is not 0, stop and return
       FF_STOPPED. */
    int32_t (*progress)(void *ctx, double fraction);

    /* Returns the table of a host extension, or NULL if this host does not have it. */
    const void *(*extension)(void *ctx, const char *id);

    /* Since 1.2. `wanted`, during evaluate: non-zero if output row `output` is wanted; rows from 64
       on have no bit in the argument of evaluate. `given`, from ready on: non-zero if the user gave
       parameter row `param`. */
    int32_t (*wanted)(void *ctx, uint32_t output);
    int32_t (*given)(void *ctx, uint32_t param);

    /* Since 1.2, in ready. States that, with these settings, `item` affects only the outputs in the
       list "film|pressure", or no output if the list is "". `item` is a parameter, an input, a
       wire, or the column "file.time" of a table. `by`: the parameter or wire that is used instead,
       or NULL. `text`: the reason, "the time steps are equal", or NULL. With this the program warns
       of settings that have no effect, and refuses a value that is given twice. An item without
       such a call affects all outputs. */
    void (*serves)(void *ctx, const char *item, const char *outputs, const char *by,
                   const char *text);
} ff_host;

/* Flags of a model. */
enum {
    FF_SERIAL = 1 /* two instances must not run at the same time */
};

/* A state that one case of a chain hands to the next: bytes in a format private to the model. They
   are stored on disk and may be read by another process, so begin them with a format mark. */
typedef struct ff_state_bytes {
    size_t size;
    const void *bytes;
    size_t count; /* at most 1 MiB; 0: no state */
} ff_state_bytes;

/*
 * A model. The engine calls an instance in this order: create; then it writes the members that have
 * a `place`; set, in row order, for each other parameter that was given or has a preset; wire, for
 * each connected input; ready; evaluate and service, any number of times; destroy. A function that
 * fails gives the reason through host->fail. Mandatory functions: `create`; `evaluate` if there are
 * data outputs; `service` if there are service outputs; `set` if there are parameters without a
 * place; `wire` if there are service inputs. `ready` and `destroy` may be NULL.
 */
typedef struct ff_model {
    size_t size;
    uint32_t abi_major, abi_minor; /* abi_minor: the oldest minor version that the model can use */
    const char *id;                /* "viscosity/barus" */
    const char *version;           /* "1.0.0" */
    const char *summary;           /* one line */
    const char *reference;         /* literature in plain text: "Barus 1893, Am. J. Sci. 45" */
    const char *bibtex;            /* the literature as BibTeX entries */
    const char *licence;           /* SPDX expression */
    uint32_t flags;

    const ff_param *params;
    size_t param_count, param_stride;
    const ff_port *inputs;
    size_t input_count, input_stride;
    const ff_port *outputs; /* at most 64 before 1.2 */
    size_t output_count, output_stride;

    ff_status (*create)(const ff_host *host, void **self);
    ff_status (*set)(void *self, uint32_t param, const ff_value *value);
    /* service: the table of a service input, ready for use; NULL for a data input. */
    ff_status (*wire)(void *self, uint32_t input, const void *service);
    /* Checks parameters against each other. It must be cheap, since `check` calls it. */
    ff_status (*ready)(void *self);
    /* Bit i of `wanted` is set if output row i is wanted; giving other outputs is allowed. in[i]
       belongs to input row i. The result must depend only on the parameters, the wires, `wanted`,
       `in`, and the state that `carry` brought. */
    ff_status (*evaluate)(void *self, uint64_t wanted, const ff_array *in);
    /* The table of service output `output`, valid as long as the instance. */
    const void *(*service)(void *self, uint32_t output);
    void (*destroy)(void *self); /* accepts NULL */

    /* Since 1.1; may be NULL, test it with FF_HAS. In a chain, each case starts from the state of
       the case before. The engine calls carry before evaluate with `from` (`to` is NULL); its bytes
       are valid during the call and apply to the next evaluate only. After evaluate it calls carry
       with `to` (`from` is NULL), which the model fills in; these bytes must stay valid until the
       next call of the instance. If the model cannot read `from`, evaluate starts as for a single
       case. */
    ff_status (*carry)(void *self, const ff_state_bytes *from, ff_state_bytes *to);

    void (*reserved[2])(void); /* must be NULL */

    /* Since 1.1; NULL: none. The columns of the tables named by FF_FILE parameters, in the form of
       table.h, for the model's documentation. */
    const ff_param *columns;
    size_t column_count, column_stride;

    /* Since 1.2. */
    size_t self_size; /* size in bytes of the object that create returns; every `place` must lie
                         inside it. 0: no row has a place */
    double cost;      /* seconds on one core for a typical evaluation; for a law, for a million
                         points. If a file leaves the model open, cheaper models are tried first. 0:
                         unknown; the model is then never tried */
} ff_model;

#if defined(__GNUC__)
#define FF_EXPORT __attribute__((visibility("default")))
#else
#define FF_EXPORT
#endif

/* A plugin exports one of these two functions. The list ends with NULL; the engine uses the model
   whose id belongs to the path of the file. */
FF_EXPORT const ff_model *flankfilm_model_v1(void);
FF_EXPORT const ff_model *const *flankfilm_models_v1(void);

#ifdef __cplusplus
}
#endif
#endif
