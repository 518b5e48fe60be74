/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef REWRITE_PRIVATE_H
#define REWRITE_PRIVATE_H

#include "rewrite.h"

#include "../memory/memory.h"

#include <stdio.h>

enum { REWRITE_FILES = 32, REWRITE_LAWS = 16 };

/* A card of format 1, which said the oil at one temperature under each law. */
typedef struct rewrite_card {
    const char *old, *now;   /* names of the files */
    const char *temperature; /* that its eta0 held at */
    const char *density;
} rewrite_card;

const rewrite_card *rewrite_card_at(size_t index); /* NULL beyond the last */

/* A file by itself, without what it includes. */
typedef struct rewrite_file {
    char *path, *text;   /* text NULL: an example that came with the program */
    ff_tree *tree;       /* NULL: it cannot be read */
    const ff_node *root; /* or NULL */
    bool old;            /* it says format: 1 */
    bool current;        /* it is of format 2 */
} rewrite_file;

/* How the oil is said in format 2. */
typedef enum rewrite_mode {
    REWRITE_NONE, /* there is nothing to move */
    REWRITE_OIL,  /* by a stage */
    REWRITE_EACH, /* by a stage for each of several viscosity laws */
    REWRITE_BARE  /* by eta0 and rho0 of the laws, since no temperature is known */
} rewrite_mode;

/* A file of format 1 and all that it includes, the file itself last. */
typedef struct rewrite_world {
    rewrite_file files[REWRITE_FILES];
    size_t count;
    const char *viscosity, *density; /* old names of the stages of the laws; NULL: none */
    const char *other[REWRITE_LAWS]; /* further viscosity laws */
    size_t others;
    bool shipped;                /* an example is included, whose stages have new names */
    bool has_losses, has_grade;  /* a grade or nu_40 */
    bool has_oil;                /* a stage of an oil already */
    const char *operating;       /* name of the stage; NULL: none */
    const char *oil_temperature; /* that the operating stage is given; or NULL */
    bool has_surface;            /* a stage of rough flanks */
    const char *rough_gear;      /* the stage that says a roughness, too; or NULL */
    const char *roughness;       /* its parameter */
    const rewrite_card *card;
    const char *law;                       /* the viscosity model in use; or NULL */
    const char *eta0, *temperature, *rho0; /* as the laws in use have them; or NULL */
    rewrite_mode mode;
} rewrite_world;

/* read.c: false when the file is not of format 1, nor any that it includes. Closed either way. */
bool rewrite_read(rewrite_world *world, const char *path);
void rewrite_close(rewrite_world *world);

/* stages.c */
bool rewrite_is_viscosity(const rewrite_world *world, const char *name, const ff_node *node);
bool rewrite_is_density(const rewrite_world *world, const char *name, const ff_node *node);
/* A value of the law's stage or of one of its sets, that of the model in use first; or NULL. */
const ff_node *rewrite_value(const rewrite_world *world, const ff_node *node, const char *key);
/* Whether the key said in a law which oil it is. */
bool rewrite_is_of_oil(const char *key);

/* A stage that is to be printed. */
typedef struct rewrite_part {
    char *own;  /* lines "key: value"; NULL: none */
    char *sets; /* lines "model: {...}" that stand under `with`; NULL: none */
} rewrite_part;

/* What the stage of a law becomes. */
typedef struct rewrite_stages {
    rewrite_part oil, viscosity, density, operating;
    char *remarks; /* lines; or NULL */
} rewrite_stages;

void rewrite_split_viscosity(const rewrite_world *world, const ff_node *node, rewrite_stages *to);
/* Of several viscosity laws: the law takes its own oil by the name, or keeps its eta0. */
void rewrite_split_of_several(const rewrite_world *world, const char *name, const char *oil,
                              const ff_node *node, rewrite_stages *to);
void rewrite_split_density_of_several(const rewrite_world *world, const ff_node *node,
                                      rewrite_stages *to);
void rewrite_split_density(const ff_node *node, rewrite_stages *to);
void rewrite_free_stages(rewrite_stages *stages);

/* words.c: the text with its paths ("oil.temperature"), wires and cards as they are written now. */
void rewrite_print_words(const rewrite_world *world, const char *text, size_t length, FILE *out);
/* A path alone, as of an assignment. */
void rewrite_print_path(const rewrite_world *world, const char *path, size_t length, FILE *out);

/* print.c: the whole file. */
void rewrite_print_file(const rewrite_world *world, const rewrite_file *file, FILE *out);

#endif
