/* SPDX-License-Identifier: MIT */
/*
 * flankfilm plugin interface, major version 1.
 *
 * A plugin is a shared object that exports one function: flankfilm_model_v1(), which returns a
 * constant ff_model, or flankfilm_models_v1(), which returns several. The id of a model is
 * "kind/name" and its path is <plugin dir>/kind/name.so; the ids of further models in one object
 * are symbolic links to it. It links to nothing of flankfilm's. It never prints, never exits, and
 * leaves the floating-point environment, the locale and the signal handlers as they are. Compile
 * with -std=c11 -fPIC -fvisibility=hidden.
 *
 * Growing structs begin with `size`, set by whoever fills them in: test a later field with FF_HAS.
 * Rows of a table are found by the stride that the model states. All numbers that cross the border
 * are coherent SI with angles in rad, except the limits inside an ff_param row, which are written
 * in that row's unit, as users read them. Strings are UTF-8, constant and live as long as the
 * plugin. Arrays are row-major, contiguous and never overlap; a count of 0 is legal everywhere.
 *
 * Threads: one instance is used by one thread at a time; instances of one model may run in
 * parallel unless the model says FF_SERIAL. Service tables are pure: any number of threads.
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

/* True when struct *s, as its maker compiled it, has `field`. */
#define FF_HAS(s, field)                                                                           \
    ((size_t)((const char *)(&(s)->field + 1) - (const char *)(s)) <= (s)->size)

/* A positive status is about the numbers, a negative one about the call. */
typedef int32_t ff_status;
enum {
    FF_OK = 0,
    FF_DOMAIN = 1,       /* values were computed, but outside the range the model is made for */
    FF_NOCONV = 2,       /* the computation failed: no convergence, no solution */
    FF_STOPPED = 3,      /* stopped because host->progress asked for it */
    FF_INVALID = -1,     /* a parameter or an input cannot be used */
    FF_NOMEM = -2,       /* out of memory */
    FF_UNSUPPORTED = -3, /* a legal request that this model does not serve */
    FF_BUG = -4          /* the model found its own invariant broken */
};

/* What a user may write for a parameter, and the member of ff_value that carries it. */
enum {
    FF_REAL = 1, /* real: a number with the row's unit or another of its dimension */
    FF_INT,      /* integer */
    FF_BOOL,     /* integer: true 1, false 0 */
    FF_CHOICE,   /* integer: rank in `choices`, from 0; text: the word */
    FF_TEXT,     /* text */
    FF_REALS,    /* reals, count: a list; a single number is a list of one */
    FF_FILE,     /* text: a path that can be opened; it was resolved beside the YAML file */
    FF_TREE      /* reserved: no row has this type */
};

/* Flags of a parameter row. */
enum {
    FF_REQUIRED = 1, /* must be given; in a group: one member of the group must be given */
    FF_MIN_OPEN = 2, /* `min` itself is refused */
    FF_MAX_OPEN = 4, /* `max` itself is refused */
    FF_WHOLE = 8,    /* FF_REALS of whole numbers */
    FF_TUNABLE = 16, /* trades speed for accuracy, the finer the larger an FF_INT (cells, steps) or
                        the smaller an FF_REAL (tolerances, distances of points) is: errors are
                        measured by changing it */
    FF_INCREASING = 32 /* FF_REALS that must not decrease */
};

typedef struct ff_param {
    const char *name;    /* "module"; a dot stands for a nested map: "atlas.from" */
    const char *unit;    /* "mm", "1/GPa", "1"; "" where a unit makes no sense */
    const char *doc;     /* one line: what it is and what it changes */
    int32_t type;        /* FF_REAL ... */
    uint32_t flags;      /* FF_REQUIRED | ... */
    const char *preset;  /* default as a user would write it, "20 deg"; NULL: none. In a group it
                            applies when no member is given */
    const char *choices; /* "linear|cubic"; on FF_REAL and FF_INT: words accepted beside a number;
                            since 1.2 on FF_TEXT: examples that the model takes, "ISO VG 220" */
    const char *group;   /* at most one parameter of a group may be given; NULL: no group */
    double min, max;     /* physical limits, refused outside; hold when min < max */
    double low, high;    /* calibrated range, warned outside; holds when low < high */
    uint32_t min_count, max_count; /* FF_REALS: allowed lengths; max_count 0: any */

    /* Since 1.2; 0 and NULL in shorter rows. */
    size_t place;        /* 1 + offset of the member of the instance that takes the value; 0: none,
                            `set` is called. The macros of author.h check its type */
    const char *instead; /* optional input that replaces the parameter: a service, "oil"; since 1.3
                            also a data input, "gear.density", or a wire of data inputs, "gear".
                            Where it is connected, the parameter must not be given and no preset
                            applies; where it is not, FF_REQUIRED holds */
} ff_param;

/*
 * The member behind `place`, which the core writes once, after create and before wire, in SI. The
 * last column is what it holds where the parameter was not given and has no preset.
 *
 *   FF_REAL              double        NaN
 *   FF_INT               int64_t       -1
 *   FF_BOOL, FF_CHOICE   int32_t       -1
 *   FF_TEXT, FF_FILE     const char *  NULL
 *   FF_REALS             ff_reals      count 0
 *
 * A word in place of a number ("auto") reads as not given. Where words must be told apart, or -1
 * is a legal number, leave `place` 0. Texts and lists are the core's and live until destroy
 * returns.
 */
typedef struct ff_reals {
    const double *data;
    size_t count;
} ff_reals;

/* Flags of a port row. */
enum {
    FF_OPTIONAL = 1,  /* an input that may stay unconnected */
    FF_FEEDBACK = 2,  /* since 1.2: a data input that may close a loop; never connected by itself */
    FF_DIFFERENCE = 4 /* since 1.3: a data output in K is a difference of temperatures, which may be
                         negative and is not shifted where it is shown in degC */
};

/* Since 1.3: the one number that stands for a series or a field where there is no room for it. */
enum {
    FF_NO_HEADLINE = 0,
    FF_LEAST = 1,   /* of a film */
    FF_LARGEST = 2, /* of a pressure, a temperature */
    FF_MEAN = 3     /* of a loss, over the row's first dimension */
};

/*
 * A port. Data ports carry an array of doubles along named dimensions: "" a scalar, "station" a
 * series, "t x" a field; the first of "engagement? station" may be absent. Equal names on one wire,
 * and among the outputs of a stage, mean equal lengths; "t" of two wires may differ. "gear.station"
 * is that of the wire `gear`, for an input of another wire or an output (since 1.3). Positions "x"
 * of a field "t x" are an output along "x", or along "t x" where the grid moves. Service ports
 * carry a table of functions, named by its interface id.
 *
 * An input row is named "wire.output": `wire` is the key by which a YAML file names the feeding
 * stage, `output` the row that this stage must offer; an optional row stays unconnected when the
 * stage does not offer it. A service input is named by its wire; a further one of the same wire,
 * such as the optional "rheology.rate", by the wire and a word of its own.
 * A wire that the file does not name is connected when exactly one stage of the kinds in `from`
 * offers all that its rows ask for; rows of one wire state the same `from`.
 *
 * All rows of a feedback wire say FF_FEEDBACK and FF_OPTIONAL. Only a wire that the file names
 * closes a loop. Its stages are then evaluated round after round until what the feedback wires
 * carry no longer changes; in the first round these inputs are absent (data NULL), which is the
 * run without feedback.
 */
typedef struct ff_port {
    const char *name;
    const char *unit; /* coherent SI: "m", "N/m", "rad", "1"; "" for a service */
    const char *doc;
    const char *dims;    /* "", "station", "t x" */
    const char *service; /* interface id, "flankfilm.viscosity/1"; NULL: a data port */
    uint32_t flags;
    const char *from; /* inputs: "stiffness|dynamics"; NULL: the kind named like the wire */

    /* Since 1.3, of data outputs; 0 and NULL in shorter rows. */
    double min, max;   /* natural bounds, which no number of this meaning can leave, in the row's
                          unit; one may be infinite; hold when min < max. A number outside makes
                          the run fail. A row in K without FF_DIFFERENCE is never below 0 */
    const char *label; /* what it is, in words: "least film thickness"; NULL: the name */
    const char *shown; /* unit that people read, "um", of the same dimension; NULL: `unit` */
    const char
        *quantity;      /* what it is in any model, "friction coefficient of the mesh": two stages
                           of a run that give the same quantity are compared; NULL: not compared */
    const char *origin; /* input row that the number is counted from, where shares of it are
                           meant: "operating.oil_temperature"; NULL: 0 */
    int32_t headline;   /* FF_LEAST ...; of a scalar FF_NO_HEADLINE */
    double apart;       /* of a scalar with a `quantity`: how far two stages that give it may lie
                           apart, in `unit`; the larger of both holds; 0: not beyond rounding */
} ff_port;

typedef struct ff_value {
    size_t size;
    double real;
    int64_t integer;
    const char *text; /* FF_TEXT, FF_FILE, FF_CHOICE; the word written for an FF_REAL, FF_INT */
    const double *reals;
    size_t count;
    int32_t given;    /* 0: the row's preset; 1: written by the user */
    const void *tree; /* reserved: NULL */
} ff_value;           /* strings and arrays live during the call only */

typedef struct ff_array {
    const double *data;  /* NULL: not connected */
    const size_t *shape; /* `rank` lengths */
    uint32_t rank;
} ff_array;

/*
 * The verdict of a line of quality, of one of two things: whether the numbers hold (balances,
 * errors, convergence), or whether the model is used in the range that it was made for. FF_RANGE
 * and FF_DOUBTFUL are warnings; FF_BAD makes the run fail.
 */
enum {
    FF_GOOD = 0,
    FF_DOUBTFUL = 1, /* the numbers may be off */
    FF_BAD = 2,      /* the numbers are wrong */
    FF_RANGE = 3     /* since 1.3: the numbers hold, outside the range of the model */
};

/* Levels of host->log. */
enum { FF_LOG_INFO = 0, FF_LOG_WARNING = 1 };

/* What the core offers to a model; it outlives the instance. Any thread that runs the instance. */
typedef struct ff_host {
    size_t size;
    uint32_t abi_minor;
    void *ctx; /* first argument of every function below */

    /* Says why; returns `status`, so that `return host->fail(...)` reads well. `item`: the
       parameter, input or output at fault, or NULL. The core adds file, line and column. */
    ff_status (*fail)(void *ctx, ff_status status, const char *item, const char *text);
    void (*log)(void *ctx, int32_t level, const char *text);

    /* Memory for output row `index`, owned by the core, valid until evaluate is called again; NULL
       when there is none: then return FF_NOMEM. Call during evaluate, once each. It is zeroed
       where the output is wanted; where it is not, it is NaN for a model that needs 1.3, and an
       output that then has a NaN is absent. */
    double *(*output)(void *ctx, uint32_t index, uint32_t rank, const size_t *shape);

    /* One line of the stage's quality record: its value, the limit it is held to, FF_GOOD ...,
       and optionally a sentence. FF_BAD makes the run fail, with its results kept. */
    void (*quality)(void *ctx, const char *name, double value, double limit, int32_t verdict,
                    const char *text);

    /* Share of the work that is done, 0 to 1. Non-zero answer: stop and return FF_STOPPED. */
    int32_t (*progress)(void *ctx, double fraction);

    const void *(*extension)(void *ctx, const char *id); /* NULL when there is none */

    /* Since 1.2. During evaluate: non-zero when output row `output` is wanted; rows from 64 on have
       no bit in `wanted`. From ready on: non-zero when the user wrote parameter row `param`. */
    int32_t (*wanted)(void *ctx, uint32_t output);
    int32_t (*given)(void *ctx, uint32_t param);

    /* Since 1.2; in ready. With these settings the parameter `item`, or the input or wire, or the
       column "file.time" of a table, serves the outputs in the list alone, "film|pressure"; "":
       none. `by`: the parameter or wire that says the same thing in its place, or NULL. `text`:
       why, or NULL: "the time steps are equal". So the program names what a user wrote in vain, and
       refuses what stands in two places. What no call names serves all outputs. */
    void (*serves)(void *ctx, const char *item, const char *outputs, const char *by,
                   const char *text);
} ff_host;

/* Flags of a model. */
enum {
    FF_SERIAL = 1 /* no two instances may run at the same time */
};

/* A state that one case of a chain hands to the next: bytes that the model alone reads. They are
   kept on disk and may come back in another process; begin them with a mark of their format. */
typedef struct ff_state_bytes {
    size_t size;
    const void *bytes;
    size_t count; /* at most 1 MiB; 0: no state */
} ff_state_bytes;

/*
 * A model. Life of an instance: create; the members behind `place` are written; set, in row order,
 * for every other parameter that was given or has a preset; wire, for every connected input; ready;
 * then evaluate and service, any number of times; destroy. A function that fails says why through
 * host->fail. `create` is mandatory, as is `evaluate` with data outputs, `service` with service
 * outputs, `set` with parameters without a place and `wire` with service inputs; `ready` and
 * `destroy` may be NULL.
 */
typedef struct ff_model {
    size_t size;
    uint32_t abi_major, abi_minor; /* the oldest minor version that the model needs */
    const char *id;                /* "viscosity/barus" */
    const char *version;           /* "1.0.0" */
    const char *summary;           /* one line */
    const char *reference;         /* the literature, to read: "Barus 1893, Am. J. Sci. 45" */
    const char *bibtex;            /* the same as one or more BibTeX entries */
    const char *licence;           /* SPDX expression */
    uint32_t flags;

    const ff_param *params;
    size_t param_count, param_stride;
    const ff_port *inputs;
    size_t input_count, input_stride;
    const ff_port *outputs; /* before 1.2: at most 64 */
    size_t output_count, output_stride;

    ff_status (*create)(const ff_host *host, void **self);
    ff_status (*set)(void *self, uint32_t param, const ff_value *value);
    /* service: the table of a service input, usable at once; NULL for a data input. */
    ff_status (*wire)(void *self, uint32_t input, const void *service);
    /* Checks parameters against each other; cheap, since `check` calls it too. */
    ff_status (*ready)(void *self);
    /* Bit i of `wanted` asks for output row i; others may be left out or given. in[i] belongs to
       input row i. The result depends on parameters, wires, `wanted` and `in` alone, and on the
       state that `carry` brought. */
    ff_status (*evaluate)(void *self, uint64_t wanted, const ff_array *in);
    /* The table behind service output `output`; lives as long as the instance. */
    const void *(*service)(void *self, uint32_t output);
    void (*destroy)(void *self); /* accepts NULL */

    /* Since 1.1; may be NULL, test with FF_HAS. In a chain of cases each starts from its
       neighbour's state: before evaluate with `from`, whose bytes live during the call only and
       serve the next evaluate alone (`to` NULL); after it with `to` (`from` NULL), to be filled in
       with bytes that live until the next call of the instance. Without a `from` that the model
       knows how to read, evaluate starts as it would alone. */
    ff_status (*carry)(void *self, const ff_state_bytes *from, ff_state_bytes *to);

    void (*reserved[2])(void); /* NULL */

    /* Since 1.1; NULL: none. The columns of the tables that the model's FF_FILE parameters name, as
       table.h has them: for its manual. */
    const ff_param *columns;
    size_t column_count, column_stride;

    /* Since 1.2. */
    size_t self_size; /* bytes of what create returns, which every `place` stays within; 0: no row
                         has a place */
    double cost; /* seconds on one core of an ordinary evaluation, of a law for a million points:
                    where a file leaves the model open, cheaper ones are tried first; 0: it is
                    not known, and the model is never tried */
} ff_model;

#if defined(__GNUC__)
#define FF_EXPORT __attribute__((visibility("default")))
#else
#define FF_EXPORT
#endif

/* A plugin exports one of both. The list ends with NULL; the core uses the model whose id is the
   one that the file was found for. */
FF_EXPORT const ff_model *flankfilm_model_v1(void);
FF_EXPORT const ff_model *const *flankfilm_models_v1(void);

#ifdef __cplusplus
}
#endif
#endif
