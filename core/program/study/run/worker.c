/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A worker process receives numbers of cases and answers with lines for the journal. A crashing
   model therefore ends only this process. Three answers are not lines for the journal: "=" for a
   case that is already done, "!text" if the study cannot continue, and "?path" for a plugin whose
   file was overwritten. */
#include "workers.h"

#include "../../arrays/log.h"
#include "../../crash/alloc-watch.h"
#include "../../crash/lead.h"
#include "../../memory/file.h"
#include "../cases/chain.h"
#include "../cases/rows.h"
#include "../cases/walk.h"
#include "../store/journal.h"
#include "../store/reuse.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST_STAGES = 1000, LONGEST_ANSWER = 1 << 24 };
/* Number of times in a row that a worker may be found stopped before it is ended. A batch system
   that has stopped all processes of a job continues them one by one. */
enum { MOST_STOPS = 5 };

/* Limits how much further memory the process may allocate. */
static void limit_memory(const study_run *run)
{
    unsigned long pages = 0;
    double page = (double)sysconf(_SC_PAGESIZE);
    double more = run->study->memory_limit;
    FILE *stream = fopen("/proc/self/statm", "re");
    if (!stream || fscanf(stream, "%lu", &pages) != 1)
        pages = 0;
    if (stream)
        fclose(stream);
    if (!(more > 0))
        more = page * (double)sysconf(_SC_PHYS_PAGES) / (double)run->jobs;
    struct rlimit limit;
    if (pages == 0 || getrlimit(RLIMIT_AS, &limit) != 0)
        return;
    limit.rlim_cur = (rlim_t)(more + page * (double)pages);
    if (limit.rlim_max == RLIM_INFINITY || limit.rlim_cur < limit.rlim_max)
        setrlimit(RLIMIT_AS, &limit);
}

/* Limits the number of processes and threads of the user, relative to the current number, so that a
   plugin cannot start processes without end. */
static void limit_processes(void)
{
    enum { MORE = 4096 };
    unsigned long tasks = 0;
    struct rlimit limit;
    FILE *stream = fopen("/proc/loadavg", "re");
    bool known = stream && fscanf(stream, "%*f %*f %*f %*u/%lu", &tasks) == 1;
    if (stream)
        fclose(stream);
    if (!known || getrlimit(RLIMIT_NPROC, &limit) != 0 || limit.rlim_cur <= tasks + MORE)
        return;
    limit.rlim_cur = tasks + MORE;
    setrlimit(RLIMIT_NPROC, &limit);
}

bool study_open_pipes(int to[2], int from[2])
{
    if (pipe2(to, O_CLOEXEC) != 0)
        return false;
    if (pipe2(from, O_CLOEXEC) == 0)
        return true;
    close(to[0]);
    close(to[1]);
    return false;
}

/* Adds processor times in s to the record: of the whole case, and of its reused stages when they
   were computed. */
static void add_costs(const study_case *c, double spent, json_t *record)
{
    double saved = 0;
    for (size_t i = 0; c->pipeline && i < c->pipeline->count; i++)
        saved += c->pipeline->stages[i].reused ? c->pipeline->stages[i].work : 0;
    json_object_set_new(record, "processor", study_json_seconds(spent));
    json_object_set_new(record, "processor_saved", study_json_seconds(saved));
}

/* Returns the answer for an overwritten plugin: the path of its file. */
static char *answer_written_over(const study_run *run)
{
    const ff_loaded *over = ff_engine_written_over(run->engine);
    return over ? memory_print_text("%c%s\n", STUDY_VERDICT_WRITTEN_OVER, over->path) : NULL;
}

/* Returns the answer to the open case, and sets the record that is passed on, to be released. */
static char *answer_case(study_walk *walk, size_t index, study_memory *memory, clock_t start,
                         json_t **record)
{
    study_case *c = &walk->c;
    if (study_case_is_settled(c, walk->records, walk->run->rerun)) {
        *record = c->states ? study_records_get(walk->records, c->key) : NULL;
        return memory_print_text("=\n");
    }
    *record = study_case_run(c, walk->run, index, memory);
    add_costs(c, (double)(clock() - start) / CLOCKS_PER_SEC, *record);
    char *over = study_record_is_ok(*record) ? NULL : answer_written_over(walk->run);
    if (over || *record)
        return over ? over : study_journal_line(*record, memory->written_forms);
    char *why = study_first_error(c->report);
    char *line = memory_print_text("%c%s\n", STUDY_VERDICT_FATAL, why);
    free(why);
    return line;
}

static bool run_case(const study_worker *worker, study_walk *walk, size_t index,
                     study_memory *memory, int to)
{
    json_t *record;
    study_walk_to(walk, index);
    clock_t start = clock(); /* processor time, since the process does nothing but the case */
    study_walk_next(walk);
    memcpy(worker->shared->key, walk->c.key, sizeof walk->c.key);
    char *line = answer_case(walk, index, memory, start, &record);
    bool sent = file_write(to, line, strlen(line), -1);
    study_walk_leave(walk, record);
    json_decref(record);
    free(line);
    return sent;
}

/* Makes the allocator keep freed memory for the next case. Otherwise the system would provide it
   again page by page. */
static void keep_memory(void)
{
    enum { TRIM = 1 << 28, TOP_PAD = 1 << 20, MMAP = 1 << 25 };
    mallopt(M_TRIM_THRESHOLD, TRIM);
    mallopt(M_TOP_PAD, TOP_PAD);
    mallopt(M_MMAP_THRESHOLD, MMAP);
}

static bool take_case(const study_run *run, int from, size_t *index)
{
    size_t length;
    if (!file_read(from, index, sizeof *index, -1))
        return false;
    if (!run->study->streams)
        return true;
    if (!file_read(from, &length, sizeof length, -1))
        return false;
    char *row = memory_alloc(length + 1);
    bool whole = file_read(from, row, length, -1);
    if (whole)
        study_rows_put(run->study->rows, *index, row);
    free(row);
    return whole;
}

static _Noreturn void serve_cases(const study_worker *worker, const study_run *run,
                                  study_records *done, size_t slot, int from, int to)
{
    static study_reuse_stats stats[MOST_STAGES];
    size_t index;
    int null = open("/dev/null", O_RDWR);
    setpgid(0, 0); /* to end processes that a plugin starts together with the worker */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN); /* the leading process decides when to end */
    dup2(null, STDIN_FILENO);
    dup2(null, STDOUT_FILENO);
    dup2(worker->captured, STDERR_FILENO);
    keep_memory();
    limit_memory(run);
    crash_hunger_watch();
    crash_mark(&worker->shared->running);
    limit_processes();
    if (run->study->measure)
        study_measure_pin();
    char *path = memory_print_text("%s/stages", run->directory);
    mkdir(path, 0777); /* the directory may already exist */
    int stages = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    free(path);
    study_memory memory = {
        .directory = stages,
        .stats = stats,
        .arrays = {.run = run, .shared = worker->shared, .slot = slot},
        .seen = json_object(),
        .written_forms = json_object(),
    };
    study_walk walk = study_walk_begin(run, done);
    walk.kept.keys = false;
    walk.end = SIZE_MAX; /* rows may still come from standard input */
    const ff_environment *environment = ff_environment_keep();
    while (take_case(run, from, &index)) {
        ff_environment_restore(environment); /* the destroy function of a plugin may have changed
                                                it */
        if (ftruncate(worker->captured, 0) != 0 || !run_case(worker, &walk, index, &memory, to))
            break;
    }
    _exit(0);
}

static void close_files(study_worker *worker)
{
    close(worker->to);
    close(worker->from);
    close(worker->captured);
}

/* Closes, in a worker, the descriptors that belong to others. Otherwise the other workers would not
   see the end of their input, and a plugin could write into the journal. */
static void close_others(const study_worker *worker, const study_pool *pool)
{
    for (size_t i = 0; i < pool->run->jobs; i++) {
        const study_worker *other = &pool->workers[i];
        if (other->pid > 0 && other != worker) {
            close(other->to);
            close(other->from);
            close(other->captured);
        }
    }
    for (size_t i = 0; i < sizeof pool->hidden / sizeof *pool->hidden; i++)
        if (pool->hidden[i] >= 0)
            close(pool->hidden[i]);
    study_records_close_files(pool->done);
}

bool study_worker_start(study_worker *worker, const study_pool *pool)
{
    int to[2], from[2];
    if (!worker->shared) {
        worker->shared = mmap(NULL, sizeof *worker->shared, PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (worker->shared == MAP_FAILED)
            worker->shared = NULL;
    }
    if (!worker->shared || !study_open_pipes(to, from))
        return false;
    worker->captured = memfd_create("flankfilm", MFD_CLOEXEC);
    fcntl(worker->captured, F_SETFL, O_APPEND);
    fflush(NULL);
    worker->pid = fork();
    if (worker->pid == 0) {
        close_others(worker, pool);
        close(to[1]);
        close(from[0]);
        serve_cases(worker, pool->run, pool->done, (size_t)(worker - pool->workers) + 1, to[0],
                    from[1]);
    }
    close(to[0]);
    close(from[1]);
    worker->to = to[1];
    worker->from = from[0];
    worker->busy = false;
    worker->length = 0;
    if (worker->pid > 0) {
        setpgid(worker->pid, worker->pid); /* done here too, since the worker may not have done
                                              it yet */
        return true;
    }
    worker->pid = 0;
    close_files(worker);
    return false;
}

/* Sends the number of a case, and the text of its row if the worker may not have it. */
bool study_worker_send_case(study_worker *worker, const study_run *run, size_t index)
{
    const study_definition *study = run->study;
    const char *row = study->streams ? study_rows_text(study->rows, index) : NULL;
    size_t length = row ? strlen(row) : 0;
    worker->shared->key[0] = '\0';
    worker->busy = true;
    worker->index = index;
    worker->case_start = study_seconds_now();
    worker->stops = 0;
    worker->length = 0;
    return file_write(worker->to, &index, sizeof index, -1) &&
           (!row || (file_write(worker->to, &length, sizeof length, -1) &&
                     file_write(worker->to, row, length, -1)));
}

int study_worker_read(study_worker *worker)
{
    enum { BLOCK = 65536 };
    worker->line = memory_resize(worker->line, worker->length + BLOCK + 1);
    ssize_t got = read(worker->from, worker->line + worker->length, BLOCK);
    if (got < 0 && errno == EINTR)
        return 0;
    if (got <= 0 || worker->length > LONGEST_ANSWER)
        return -1;
    worker->length += (size_t)got;
    worker->line[worker->length] = '\0';
    return worker->line[worker->length - 1] == '\n';
}

static const char told[] = "error: "; /* prefix written by the worker itself */

/* Returns the first line that begins with "error: ", without that prefix, or else the first
 * line, since libraries may have written before the program did. */
static char *pick_line(const char *text)
{
    const char *line = text;
    while (line && strncmp(line, told, sizeof told - 1) != 0)
        line = (line = strchr(line, '\n')) ? line + 1 : NULL;
    line = line ? line + sizeof told - 1 : text;
    return memory_copy_text(line, strcspn(line, "\n"));
}

bool study_worker_is_ahead(const study_worker *worker)
{
    return worker->shared && worker->shared->end > worker->synced;
}

bool study_worker_sync(study_worker *worker, const study_run *run)
{
    off_t end = worker->shared->end;
    char *path = memory_print_text("%s/%s", run->directory, worker->shared->name);
    int log = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    free(path);
    bool done = log >= 0 && arrays_force(log);
    int cause = errno;
    if (log >= 0)
        close(log);
    errno = cause;
    worker->synced = done ? end : worker->synced;
    return done;
}

void study_worker_kill(const study_worker *worker)
{
    kill(worker->pid, SIGKILL);
    kill(-worker->pid, SIGKILL);
}

bool study_worker_is_gone(study_worker *worker)
{
    siginfo_t info = {.si_pid = 0};
    int state = waitid(P_PID, (id_t)worker->pid, &info, WEXITED | WSTOPPED | WNOHANG | WNOWAIT);
    bool seen = state == 0 && info.si_pid == worker->pid, stopped = info.si_code == CLD_STOPPED;
    worker->stops = !seen ? 0 : worker->stops + stopped;
    if (stopped && worker->stops == MOST_STOPS)
        study_worker_kill(worker);
    return seen && !stopped;
}

char *study_worker_reap(study_worker *worker)
{
    siginfo_t info;
    char tail[CRASH_SENTENCE] = "", text[CRASH_SENTENCE];
    int status = 0;
    off_t end = lseek(worker->captured, 0, SEEK_END);
    off_t begin = end > (off_t)sizeof tail - 1 ? end - (off_t)sizeof tail + 1 : 0;
    while (waitid(P_PID, (id_t)worker->pid, &info, WEXITED | WNOWAIT) < 0 && errno == EINTR)
        ;
    /* before it is reaped, so that its process id cannot be reused meanwhile */
    kill(-worker->pid, SIGKILL);
    while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR)
        ;
    if (worker->stops >= MOST_STOPS)
        status = W_STOPCODE(SIGSTOP);
    ssize_t length = pread(worker->captured, tail, sizeof tail - 1, begin);
    tail[length > 0 ? length : 0] = '\0';
    close_files(worker);
    worker->pid = 0;
    if (!strstr(tail, told) && crash_describe(&worker->shared->running, status, text, sizeof text))
        return memory_copy_text(text, strlen(text));
    if (*tail)
        return pick_line(tail);
    return WIFSIGNALED(status)
               ? memory_print_text("the process was ended by signal %d (%s)", WTERMSIG(status),
                                   strsignal(WTERMSIG(status)))
               : memory_print_text("the process ended with code %d", WEXITSTATUS(status));
}
