/* SPDX-License-Identifier: BSD-3-Clause */
/* Processes on one machine without a launcher: the program forks them, a socket between rank 0 and each of the others,
 * and a piece of memory that all of them have.  The others speak with rank 0 only. */
#include "coupling/run/ranks_carrier.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    BOARD_BYTES = 4096, /* of each process */
    ALIGNED = 64,
    SHORT_PAUSE = 1,    /* of who sends, until there is room [ms] */
    LONGEST_PAUSE = 100 /* of who receives, within a message: the sender may be stopped [ms] */
};

/* Begins every message. */
typedef struct {
    uint64_t bytes;
    int64_t kind;
} head;

/* The other end of a socket, and what has come of the message that is coming. */
typedef struct {
    int fd;
    pid_t pid;
    head head;
    size_t got; /* of head and data */
    char *data;
} line;

/* In memory of all processes; behind it the boards. */
typedef struct {
    atomic_int arrived, round; /* of a barrier */
} meeting;

static ranks_carrier own;
static line *lines; /* rank 0: to every rank, [0] unused; the others: one, to rank 0 */
static pid_t parent;
static meeting *met;
static size_t board_used; /* of each process's board, as far as shared */

static struct {
    line *to;
    head head;
    const char *data;
    size_t done;
} out_tray;

/* ---- when one of them ends ---- */

/* Rank 0 takes all down with a line that says so, as MPI does; another one only follows. */
static _Noreturn void end_all(const line *gone)
{
    if (own.number > 0) _exit(1);
    int how = 0;
    waitpid(gone->pid, &how, 0);
    fprintf(stderr, "breech: process %d of %d ended", (int)(gone - lines), own.count);
    if (WIFSIGNALED(how))
        fprintf(stderr, " by signal %d%s", WTERMSIG(how), WTERMSIG(how) == SIGKILL ? " (no memory left?)" : "");
    fputs("; with fewer --processes a study takes less memory, and --resume goes on with it\n", stderr);
    for (int r = 1; r < own.count; r++)
        if (&lines[r] != gone) kill(lines[r].pid, SIGKILL);
    _exit(1);
}

/* ---- messages ---- */

static line *line_to(int rank)
{
    return own.number == 0 ? &lines[rank] : lines;
}

static status begin_to_send(int to, int kind, const void *data, size_t bytes)
{
    out_tray.to = line_to(to);
    out_tray.head = (head){ bytes, kind };
    out_tray.data = data;
    out_tray.done = 0;
    return status_ok();
}

/* The other one reads on while it has something to read (more_comes). */
static bool has_room(const line *l)
{
    struct pollfd p = { .fd = l->fd, .events = POLLOUT };
    return poll(&p, 1, SHORT_PAUSE) > 0;
}

static status has_sent(bool *all)
{
    const size_t size = sizeof out_tray.head + out_tray.head.bytes;
    while (out_tray.done < size) {
        const bool in_head = out_tray.done < sizeof out_tray.head;
        const char *from = in_head ? (const char *)&out_tray.head + out_tray.done
                                   : out_tray.data + (out_tray.done - sizeof out_tray.head);
        const size_t left = (in_head ? sizeof out_tray.head : size) - out_tray.done;
        const ssize_t n = send(out_tray.to->fd, from, left, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (n < 0 && (errno == EAGAIN || errno == EINTR)) {
            if (has_room(out_tray.to)) continue;
            break;
        }
        if (n <= 0) end_all(out_tray.to);
        out_tray.done += (size_t)n;
    }
    *all = out_tray.done == size;
    return status_ok();
}

static bool is_sending(void)
{
    return out_tray.to && out_tray.done < sizeof out_tray.head + out_tray.head.bytes;
}

/* Whose message has begun goes on with it (ranks.c: run_ranks_send), a socket's room at a time: without waiting, each
 * would take as long as a step of the scene that rank 0 computes.  Two that send to each other do not wait. */
static bool more_comes(const line *l)
{
    struct pollfd p = { .fd = l->fd, .events = POLLIN };
    return l->got > 0 && !is_sending() && poll(&p, 1, LONGEST_PAUSE) > 0;
}

/* What can be read of a message now, all of it if it has begun; *whole: all of it is there. */
static status read_on(line *l, bool *whole)
{
    *whole = false;
    for (;;) {
        const size_t size = sizeof l->head + (l->got < sizeof l->head ? 0 : l->head.bytes);
        if (l->got == size) break;
        char *to = l->got < sizeof l->head ? (char *)&l->head + l->got : l->data + (l->got - sizeof l->head);
        const ssize_t n = recv(l->fd, to, size - l->got, MSG_DONTWAIT);
        if (n < 0 && (errno == EAGAIN || errno == EINTR)) {
            if (more_comes(l)) continue;
            return status_ok();
        }
        if (n <= 0) end_all(l);
        l->got += (size_t)n;
        if (l->got != sizeof l->head) continue;
        l->data = malloc(l->head.bytes + 1);
        CHECK(l->data, STATUS_MEMORY, "no memory for a message of %zu bytes", (size_t)l->head.bytes);
        l->data[l->head.bytes] = '\0';
    }
    *whole = true;
    return status_ok();
}

static status receive(message *out, bool *any)
{
    const int first = own.number == 0 ? 1 : 0, end = own.number == 0 ? own.count : 1;
    *out = (message){ .data = NULL };
    *any = false;
    for (int i = first; i < end && !*any; i++) {
        line *l = &lines[i];
        TRY(read_on(l, any));
        if (!*any) continue;
        *out = (message){ i, (int)l->head.kind, l->data, l->head.bytes };
        l->got = 0, l->data = NULL;
    }
    return status_ok();
}

/* ---- memory of all ---- */

/* Has this process ended before it came?  Who is waited for no more may have gone on to its end. */
static bool is_missing(int rank, int round)
{
    siginfo_t gone = { .si_pid = 0 };
    if (waitid(P_PID, (id_t)lines[rank].pid, &gone, WEXITED | WNOHANG | WNOWAIT) != 0) return false;
    return gone.si_pid && atomic_load(&met->round) == round;
}

static void meet(void)
{
    const int round = atomic_load(&met->round);
    if (atomic_fetch_add(&met->arrived, 1) == own.count - 1) {
        atomic_store(&met->arrived, 0);
        atomic_fetch_add(&met->round, 1);
        return;
    }
    while (atomic_load(&met->round) == round) {
        run_ranks_pause();
        if (own.number > 0 && getppid() != parent) _exit(1);
        for (int r = 1; own.number == 0 && r < own.count; r++)
            if (is_missing(r, round)) end_all(&lines[r]);
    }
}

static status share(const void *mine, size_t bytes, ranks_memory *out)
{
    const size_t all = (bytes * (size_t)own.count + ALIGNED - 1) / ALIGNED * ALIGNED;
    CHECK(board_used + all <= BOARD_BYTES * (size_t)own.count, STATUS_MEMORY, "no room for %zu bytes of %d processes",
          bytes, own.count);
    out->n = own.count, out->me = own.number, out->window = NULL;
    out->part = (char *)met + ALIGNED + board_used;
    out->bytes = all;
    board_used += all;
    memcpy((char *)out->part + bytes * (size_t)own.number, mine, bytes);
    meet();
    return status_ok();
}

/* In the opposite order of sharing. */
static void unshare(ranks_memory *m)
{
    meet(); /* nobody reads it any more */
    board_used -= m->bytes;
}

/* ---- start and end ---- */

static void finish(void)
{
    if (own.number == 0)
        for (int r = 1; r < own.count; r++) {
            waitpid(lines[r].pid, NULL, 0);
            close(lines[r].fd);
        }
    free(lines);
    munmap(met, ALIGNED + BOARD_BYTES * (size_t)own.count);
}

/* What a terminal or a system that shuts down says, rank 0 hears. */
static void become(int rank, int fd)
{
    signal(SIGINT, SIG_IGN), signal(SIGTERM, SIG_IGN), signal(SIGHUP, SIG_IGN);
    for (int r = 1; r < rank; r++) close(lines[r].fd);
    own.number = rank;
    lines[0] = (line){ .fd = fd };
}

static status fork_one(int rank)
{
    int ends[2];
    CHECK(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0, STATUS_IO, "--processes: no socket: %s",
          strerror(errno));
    const pid_t pid = fork();
    if (pid < 0) close(ends[0]), close(ends[1]);
    CHECK(pid >= 0, STATUS_IO, "--processes: process %d cannot be started: %s", rank, strerror(errno));
    close(ends[pid == 0 ? 0 : 1]);
    if (pid == 0)
        become(rank, ends[1]);
    else
        lines[rank] = (line){ .fd = ends[0], .pid = pid };
    return status_ok();
}

status run_ranks_fork(int processes, const ranks_carrier **out)
{
    own = (ranks_carrier){ .finish = finish,
                           .count = processes,
                           .on_machine = processes,
                           .send = begin_to_send,
                           .sent = has_sent,
                           .receive = receive,
                           .share = share,
                           .unshare = unshare };
    lines = calloc((size_t)processes, sizeof *lines);
    CHECK(lines, STATUS_MEMORY, "no memory for %d processes", processes);
    met = mmap(NULL, ALIGNED + BOARD_BYTES * (size_t)processes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1,
               0);
    CHECK(met != MAP_FAILED, STATUS_MEMORY, "no memory for %d processes", processes);
    parent = getpid();
    fflush(NULL);
    for (int rank = 1; rank < processes && own.number == 0; rank++) TRY(fork_one(rank));
    *out = &own;
    return status_ok();
}
