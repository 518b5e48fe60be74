/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli-harness.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char scratch[32] = "/tmp/flankfilm-cli-";
static outcome last;
static char *last_file;

static const char pair[] = "format: 2\n"
                           "title: a pair of toys\n"
                           "pipeline:\n"
                           "  wave: {use: toy/wave, amplitude: 2 mm}\n"
                           "  sum: {use: toy/sum, wave: wave}\n"
                           "  idle: {use: toy/wave, amplitude: 1 mm}\n"
                           "outputs: [sum.sum, wave.height]\n";

static void die(const char *what)
{
    perror(what);
    exit(99);
}

static void link_toy(const char *module)
{
    char from[PATH_MAX], to[PATH_MAX];
    const char *name = strstr(module, "cli-toy-");
    if (!name || !realpath(module, from))
        die(module);
    snprintf(to, sizeof to, "%s/plugins/toy/%s", scratch, name + strlen("cli-toy-"));
    if (symlink(from, to) != 0)
        die(to);
}

void cli_open(int argc, char **argv)
{
    char path[PATH_MAX];
    memset(scratch + strlen(scratch), 'X', 6); /* as mkdtemp wants it */
    if (argc < 3 || !realpath(argv[1], path) || !mkdtemp(scratch))
        die("arguments: program module...");
    setenv("F", path, 1);
    snprintf(path, sizeof path, "%s/plugins", scratch);
    setenv("FLANKFILM_PLUGIN_PATH", path, 1);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/plugins/toy", scratch);
    mkdir(path, 0777);
    for (int i = 2; i < argc; i++)
        link_toy(argv[i]);
    unsetenv("NO_COLOR");
    if (chdir(scratch) != 0)
        die(scratch);
    cli_write("pair.yaml", pair);
}

static void forget(void)
{
    free(last.out);
    free(last.err);
    json_decref(last.json);
    last = (outcome){0};
}

int cli_close(void)
{
    char line[PATH_MAX];
    forget();
    free(last_file);
    last_file = NULL;
    snprintf(line, sizeof line, "chmod -R u+w %s; rm -rf %s", scratch, scratch);
    if (chdir("/") != 0 || system(line) != 0)
        die(line);
    return check_done();
}

static char *read_all(const char *name)
{
    FILE *stream = fopen(name, "r");
    char *text = NULL;
    size_t size = 0;
    if (stream && getdelim(&text, &size, '\0', stream) < 0 && text)
        text[0] = '\0';
    if (stream)
        fclose(stream);
    return text ? text : strdup("");
}

static json_t *only_object(const char *text)
{
    json_error_t error;
    size_t length = strlen(text);
    if (length < 2 || strchr(text, '\n') != text + length - 1)
        return NULL;
    return json_loads(text, JSON_REJECT_DUPLICATES, &error);
}

outcome cli(const char *line)
{
    char *whole = NULL;
    forget();
    if (asprintf(&whole, "{ %s ; } >.out 2>.err", line) < 0)
        die("memory");
    int status = system(whole);
    free(whole);
    last.code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    last.out = read_all(".out");
    last.err = read_all(".err");
    last.json = only_object(last.out);
    return last;
}

void cli_write(const char *name, const char *text)
{
    FILE *stream = fopen(name, "w");
    if (!stream || fputs(text, stream) < 0 || fclose(stream) != 0)
        die(name);
}

const char *cli_read(const char *name)
{
    free(last_file);
    last_file = read_all(name);
    return last_file;
}

bool cli_exists(const char *name)
{
    return access(name, F_OK) == 0;
}

bool cli_has(const char *text, const char *part)
{
    return strstr(text, part) != NULL;
}

void cli_expect(const char *what, const outcome *result, bool condition)
{
    check_true(what, condition);
    if (!condition)
        printf("  exit code %d\n  stdout: %.2000s\n  stderr: %.2000s\n", result->code, result->out,
               result->err);
}

json_t *cli_at(const json_t *json, const char *path)
{
    char key[128];
    json_t *at = (json_t *)(size_t)json;
    while (at && *path) {
        size_t length = strcspn(path, "/");
        snprintf(key, sizeof key, "%.*s", (int)length, path);
        path += length + (path[length] == '/');
        at = json_is_array(at) ? json_array_get(at, (size_t)strtoul(key, NULL, 10))
                               : json_object_get(at, key);
    }
    return at;
}

const char *cli_text_at(const json_t *json, const char *path)
{
    const char *text = json_string_value(cli_at(json, path));
    return text ? text : "";
}
