/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the ranks of an MPI job as a task farm. Rank 0 distributes the tasks, and also runs tasks
   itself. Each rank runs as many tasks at a time as it has slots, and gets a new task whenever one
   is finished. No rank blocks inside MPI, since that would keep a core busy. */
#include <flankfilm/author.h>
#include <flankfilm/executor.h>

#include <mpi.h>
#include <stdbool.h>
#include <stdlib.h>
#include <time.h>

enum { TASK = 1, END, ANSWER, OVER, LOST }; /* message tags */

typedef struct farm {
    const ff_host *host;
    ff_executor service;
    int rank, ranks;
} farm;

/* The state of the other ranks, on rank 0. */
typedef struct leader {
    const farm *f;
    const ff_tasks *t;
    int *slots;  /* number of tasks that each rank can run at a time */
    int *busy;   /* number of tasks that each rank is running */
    int working; /* sum of `busy` */
    bool ended;  /* whether no tasks are left */
    bool lost;   /* whether the workers of a rank have died, with their tasks */
} leader;

static void send_next(leader *w, int rank)
{
    size_t task = 0;
    if (!w->ended && !w->t->next(w->t->ctx, &task))
        w->ended = true;
    if (w->ended)
        return;
    if (rank == 0)
        w->t->give(w->t->ctx, task);
    else
        MPI_Send(&task, sizeof task, MPI_BYTE, rank, TASK, MPI_COMM_WORLD);
    w->busy[rank]++;
    w->working++;
}

static void drop_rank(leader *w, int rank)
{
    w->lost = true;
    w->working -= w->busy[rank];
    w->busy[rank] = w->slots[rank] = 0;
}

static void record_answer(leader *w, int rank, bool over, const void *answer, size_t size)
{
    w->t->note(w->t->ctx, answer, size);
    if (!over)
        return;
    w->busy[rank]--;
    w->working--;
    if (w->busy[rank] < w->slots[rank])
        send_next(w, rank);
}

/* Receives a message from another rank; false if there is none. */
static bool receive(leader *w)
{
    MPI_Status message;
    int there, size;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &message);
    if (!there)
        return false;
    int rank = message.MPI_SOURCE, tag = message.MPI_TAG;
    MPI_Get_count(&message, MPI_BYTE, &size);
    char *answer = malloc((size_t)size + 1);
    if (!answer)
        MPI_Abort(MPI_COMM_WORLD, 1); /* without memory for the message, this rank cannot end the
                                         job in order */
    MPI_Recv(answer, size, MPI_BYTE, rank, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (tag == LOST)
        drop_rank(w, rank);
    else
        record_answer(w, rank, tag == OVER, answer, (size_t)size);
    free(answer);
    return true;
}

/* Takes the answer of a finished task in this process. Sleeps up to 1 ms if there is none; the
   sleep is short while answers arrive often. */
static int32_t poll_worker(const ff_tasks *t, bool busy, int *idle, size_t *task,
                           const void **answer, size_t *size)
{
    const struct timespec nap = {0, *idle < 100 ? 20000 : 1000000};
    int32_t state = busy ? t->take(t->ctx, *idle < 100 ? 0 : 1, task, answer, size) : FF_TASK_NONE;
    if (state == FF_TASK_NONE && (!busy || *idle < 100))
        nanosleep(&nap, NULL);
    *idle = state == FF_TASK_NONE ? *idle + 1 : 0;
    return state;
}

static void hand_out(leader *w)
{
    int idle = 0, most = 1;
    for (int k = 0; k < w->f->ranks; k++)
        most = w->slots[k] > most ? w->slots[k] : most;
    for (int n = 0; n < most; n++) /* each round hands out one task per rank */
        for (int k = 0; k < w->f->ranks; k++)
            if (n < w->slots[k])
                send_next(w, k);
    while (w->working > 0) {
        const void *answer;
        size_t task, size;
        while (receive(w))
            idle = 0;
        int32_t state = poll_worker(w->t, w->busy[0] > 0, &idle, &task, &answer, &size);
        if (state == FF_TASK_GONE)
            drop_rank(w, 0);
        else if (state != FF_TASK_NONE)
            record_answer(w, 0, state == FF_TASK_OVER, answer, size);
    }
}

static ff_status lead(const farm *f, const ff_tasks *t, int *slots)
{
    leader w = {.f = f, .t = t, .slots = slots, .busy = calloc((size_t)f->ranks, sizeof(int))};
    if (w.busy)
        hand_out(&w);
    for (int k = 1; k < f->ranks; k++)
        MPI_Send(NULL, 0, MPI_BYTE, k, END, MPI_COMM_WORLD);
    free(w.busy);
    if (!w.busy)
        return FF_NOMEM;
    return w.lost ? f->host->fail(f->host->ctx, FF_NOCONV, NULL,
                                  "the workers of a rank have died; repeat the command to continue")
                  : FF_OK;
}

/* Runs on all ranks but 0: runs the tasks that rank 0 sends, until it sends END. */
static void follow(const ff_tasks *t)
{
    int working = 0, idle = 0, there;
    for (;;) {
        const void *answer = NULL;
        size_t task, size = 0;
        MPI_Status message;
        MPI_Iprobe(0, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &message);
        if (there) {
            MPI_Recv(&task, sizeof task, MPI_BYTE, 0, message.MPI_TAG, MPI_COMM_WORLD,
                     MPI_STATUS_IGNORE);
            if (message.MPI_TAG == END)
                return;
            t->give(t->ctx, task);
            working++;
            idle = 0;
            continue;
        }
        int32_t state = poll_worker(t, working > 0, &idle, &task, &answer, &size);
        if (state == FF_TASK_NONE)
            continue;
        int tag = state == FF_TASK_GONE ? LOST : state == FF_TASK_OVER ? OVER : ANSWER;
        working = tag == LOST ? 0 : working - (tag == OVER);
        MPI_Send(answer, (int)size, MPI_BYTE, 0, tag, MPI_COMM_WORLD);
    }
}

static ff_status farm_out(farm *f, const ff_tasks *t)
{
    int slots = (int)t->slots, good;
    MPI_Comm_rank(MPI_COMM_WORLD, &f->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &f->ranks);
    good = f->rank != 0 || t->lead(t->ctx) >= 0;
    MPI_Bcast(&good, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (!good)
        return FF_OK; /* rank 0 reports the reason */
    int *all = calloc((size_t)f->ranks, sizeof *all);
    if (!all)
        return f->host->fail(f->host->ctx, FF_NOMEM, NULL, "there is no memory for the ranks");
    MPI_Gather(&slots, 1, MPI_INT, all, 1, MPI_INT, 0, MPI_COMM_WORLD);
    ff_status status = FF_OK;
    if (f->rank == 0)
        status = lead(f, t, all);
    else
        follow(t);
    free(all);
    return status;
}

static ff_status run(void *self, const ff_tasks *tasks)
{
    farm *f = self;
    if (MPI_Init(NULL, NULL) != MPI_SUCCESS)
        return f->host->fail(f->host->ctx, FF_UNSUPPORTED, NULL, "MPI cannot be used here");
    ff_status status = farm_out(f, tasks);
    MPI_Finalize();
    return status;
}

FF_SERVICE_MODEL(
    executor_mpi, farm, "executor", FF_EXECUTOR_ID, "a task farm over MPI",
    ((ff_executor){.size = sizeof(ff_executor), .run = run}), .id = "executor/mpi",
    .version = "1.0.0",
    .summary = "the ranks of an MPI job: mpirun -n 4 flankfilm run FILE --executor mpi",
    .reference = "", .bibtex = "", .licence = "GPL-3.0-or-later");
FF_EXPORT_MODELS(&executor_mpi);
