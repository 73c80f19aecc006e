/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/outdir.h"

#include <cJSON.h>
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- a file appears at once or not at all ---- */

static status path_join(const char *dir, const char *name, char *path, size_t size)
{
    const int n = snprintf(path, size, "%s/%s", dir, name);
    CHECK(n > 0 && (size_t)n < size, STATUS_IO, "%.200s/%.100s: path longer than %zu characters", dir, name, size - 1);
    return status_ok();
}

status host_file_begin(file_writer *w, const char *path)
{
    const int n = snprintf(w->path, sizeof w->path, "%s", path);
    CHECK(n > 0 && (size_t)n < sizeof w->path, STATUS_IO, "%.200s...: path longer than %d characters", path,
          OUTDIR_PATH_SIZE - 1);
    snprintf(w->part, sizeof w->part, "%s.part", path);
    w->stream = fopen(w->part, "wb");
    CHECK(w->stream, STATUS_IO, "%.300s: cannot be written: %s", w->part, strerror(errno));
    return status_ok();
}

/* The rename itself must survive a power cut, so the directory is synchronised too; file systems that cannot, do not.
 */
static void sync_parent(const char *path)
{
    char dir[OUTDIR_PATH_SIZE];
    snprintf(dir, sizeof dir, "%s", path);
    char *slash = strrchr(dir, '/');
    if (slash) slash[slash == dir ? 1 : 0] = '\0';
    const int fd = open(slash ? dir : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return;
    fsync(fd);
    close(fd);
}

/* Why not all of a stream is on the disk; NULL where it is. */
static const char *why_unwritten(FILE *stream)
{
    const bool lost = ferror(stream); /* the reason was for the one who wrote; a flush that fails says it again */
    if (fflush(stream) != 0) return strerror(errno);
    if (lost) return "not all of it was taken; is the disk full?";
    return fsync(fileno(stream)) != 0 ? strerror(errno) : NULL;
}

status host_file_end(file_writer *w, bool keep)
{
    const char *why = keep ? why_unwritten(w->stream) : NULL;
    if (fclose(w->stream) != 0 && keep && !why) why = strerror(errno);
    w->stream = NULL;
    if (keep && !why && rename(w->part, w->path) != 0) why = strerror(errno);
    if (!keep || why) unlink(w->part);
    CHECK(!why, STATUS_IO, "%.300s: cannot be written: %s", w->path, why);
    if (keep) sync_parent(w->path);
    return status_ok();
}

status host_file_write(const char *path, const void *data, size_t bytes)
{
    file_writer w;
    TRY(host_file_begin(&w, path));
    if (bytes > 0 && fwrite(data, 1, bytes, w.stream) != bytes) {
        const int error = errno;
        host_file_end(&w, false);
        return base_status_error(STATUS_IO, "%.300s: cannot be written: %s", path, strerror(error));
    }
    return host_file_end(&w, true);
}

static status read_open_file(FILE *f, const char *path, char **data, size_t *bytes)
{
    struct stat info;
    CHECK(fstat(fileno(f), &info) == 0 && S_ISREG(info.st_mode), STATUS_IO, "%.300s: is not a file", path);
    const size_t size = (size_t)info.st_size;
    char *text = malloc(size + 1);
    CHECK(text, STATUS_MEMORY, "%.300s: no memory for its %zu bytes", path, size);
    if (fread(text, 1, size, f) != size) {
        free(text);
        return base_status_error(STATUS_IO, "%.300s: cannot be read to its end", path);
    }
    text[size] = '\0';
    *data = text;
    if (bytes) *bytes = size;
    return status_ok();
}

status host_file_read(const char *path, char **data, size_t *bytes)
{
    *data = NULL;
    FILE *f = fopen(path, "rb");
    CHECK(f, STATUS_IO, "%.300s: cannot be read: %s", path, strerror(errno));
    const status s = read_open_file(f, path, data, bytes);
    fclose(f);
    return s;
}

/* ---- the directory ---- */

status host_outdir_default(const char *case_name, char *path, size_t size)
{
    char name[128];
    size_t n = 0;
    for (const char *c = case_name; *c && n + 1 < sizeof name; c++)
        name[n++] = isalnum((unsigned char)*c) || strchr("-_.", *c) ? *c : '-';
    name[n] = '\0';
    if (strspn(name, ".") == n) snprintf(name, sizeof name, "case");
    return path_join("out", name, path, size);
}

status host_folder_make(const char *path)
{
    char part[OUTDIR_PATH_SIZE];
    const int n = snprintf(part, sizeof part, "%s", path);
    CHECK(n > 0 && (size_t)n < sizeof part, STATUS_BAD_INPUT,
          "output directory: the path has %d characters, at most %d", n, OUTDIR_PATH_SIZE - 1);
    for (char *c = part + 1;; c++) {
        if (*c != '/' && *c != '\0') continue;
        const char kept = *c;
        *c = '\0';
        CHECK(mkdir(part, 0777) == 0 || errno == EEXIST || errno == EISDIR, STATUS_IO,
              "%.300s: this directory cannot be made: %s", part, strerror(errno));
        if (!kept) return status_ok();
        *c = kept;
    }
}

status host_folder_probe(const char *dir)
{
    char probe[OUTDIR_PATH_SIZE];
    TRY(path_join(dir, ".probe.part", probe, sizeof probe));
    const int fd = open(probe, O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
    CHECK(fd >= 0, STATUS_IO, "%.300s: cannot be written to: %s", dir, strerror(errno));
    close(fd);
    unlink(probe);
    return status_ok();
}

/* The descriptor holds the lock; it goes with the process, however that ends.  File systems without locks get none. */
static status lock_directory(const char *dir, int *lock)
{
    *lock = open(dir, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    CHECK(*lock >= 0, STATUS_IO, "%.300s: cannot be opened as a directory: %s", dir, strerror(errno));
    if (flock(*lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return status_ok();
    close(*lock);
    *lock = -1;
    return base_status_error(STATUS_BAD_INPUT, "%.300s: another run is writing there; wait for it or give another -o",
                             dir);
}

static bool has_suffix(const char *name, const char *suffix)
{
    const size_t n = strlen(name), m = strlen(suffix);
    return n >= m && strcmp(name + n - m, suffix) == 0;
}

/* A name that a run gives its files, those half written too. */
static bool is_ours(const char *name)
{
    static const char *const names[] = { OUTDIR_SUMMARY, OUTDIR_HISTORY, OUTDIR_CHECKPOINT, OUTDIR_REPORT,
                                         OUTDIR_SWEEP,   OUTDIR_USED,    "scene.hdf.series" };
    char whole[256];
    const size_t n = strlen(name);
    snprintf(whole, sizeof whole, "%.*s", (int)(has_suffix(name, ".part") ? n - strlen(".part") : n), name);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(whole, names[i]) == 0) return true;
    const bool snapshot =
        strncmp(whole, "scene-", 6) == 0 && strcmp(whole + 6 + strspn(whole + 6, "0123456789"), ".hdf") == 0;
    return snapshot || (strncmp(whole, "plot-", 5) == 0 && has_suffix(whole, ".svg"));
}

/* What a run wrote there and nothing else: an unknown file, and the folder that holds it, stay.  `only_look`: removes
 * nothing.  *first: the first whole file of such a name, "" if there is none. */
static void visit_ours(const char *dir, int depth, bool only_look, char first[OUTDIR_PATH_SIZE])
{
    DIR *d = opendir(dir);
    if (!d) return;
    for (const struct dirent *e; (e = readdir(d));) {
        char path[OUTDIR_PATH_SIZE];
        if (e->d_name[0] == '.' || path_join(dir, e->d_name, path, sizeof path).code != STATUS_OK) continue;
        if (is_ours(e->d_name)) {
            if (!first[0] && !has_suffix(path, ".part")) memcpy(first, path, sizeof path);
            if (!only_look) unlink(path);
        }
        if (depth == 1 || (depth == 0 && strcmp(e->d_name, "scenes") == 0)) {
            visit_ours(path, depth + 1, only_look, first);
            if (!only_look) rmdir(path);
        }
    }
    closedir(d);
}

static void remove_ours(const char *dir, int depth)
{
    char first[OUTDIR_PATH_SIZE] = "";
    visit_ours(dir, depth, false, first);
}

void host_outdir_status(const char *dir, char *out, size_t size)
{
    char path[OUTDIR_PATH_SIZE], *text;
    out[0] = '\0';
    if (path_join(dir, OUTDIR_SUMMARY, path, sizeof path).code != STATUS_OK ||
        host_file_read(path, &text, NULL).code != STATUS_OK)
        return;
    cJSON *root = cJSON_Parse(text);
    const char *word = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "status"));
    if (word) snprintf(out, size, "%s", word);
    cJSON_Delete(root);
    free(text);
}

/* A run left it: its used.yaml, or its summary. */
static bool is_of_a_run(const char *dir, const char *state)
{
    char path[OUTDIR_PATH_SIZE], *text;
    if (strcmp(state, "done") == 0 || strcmp(state, "stopped") == 0 || strcmp(state, "failed") == 0) return true;
    if (path_join(dir, OUTDIR_USED, path, sizeof path).code != STATUS_OK ||
        host_file_read(path, &text, NULL).code != STATUS_OK)
        return false;
    const bool begins = strncmp(text, OUTDIR_RUN_BY, strlen(OUTDIR_RUN_BY)) == 0;
    free(text);
    return begins;
}

/* Files of others that happen to have the names of a run's stay. */
static status check_foreign(const char *dir, const char *state)
{
    char first[OUTDIR_PATH_SIZE] = "";
    if (is_of_a_run(dir, state)) return status_ok();
    visit_ours(dir, 0, true, first);
    CHECK(!first[0], STATUS_BAD_INPUT,
          "%.300s: a run would replace it, and no run of Breech has left it there; -o names another directory, --force "
          "removes files of such names",
          first);
    return status_ok();
}

static status decide(outdir *d, outdir_options options)
{
    char state[16], checkpoint[OUTDIR_PATH_SIZE];
    host_outdir_status(d->path, state, sizeof state);
    TRY(host_outdir_file(d, OUTDIR_CHECKPOINT, checkpoint, sizeof checkpoint));
    const bool finished = strcmp(state, "done") == 0, stopped = host_file_exists(checkpoint);
    d->state = OUTDIR_NEW;
    if (options.resume) {
        d->state = finished ? OUTDIR_FINISHED : stopped ? OUTDIR_RESUMED : OUTDIR_NEW;
    } else if (!options.force) {
        CHECK(!finished, STATUS_BAD_INPUT,
              "%.300s: holds a finished result; --force overwrites it, -o names another directory", d->path);
        CHECK(!stopped, STATUS_BAD_INPUT, "%.300s: holds a stopped run; --resume goes on with it, --force starts over",
              d->path);
    }
    if (d->state != OUTDIR_NEW) return status_ok();
    if (!options.force) TRY(check_foreign(d->path, state));
    remove_ours(d->path, 0);
    return status_ok();
}

status host_outdir_open(const char *path, outdir_options options, outdir *out)
{
    CHECK(!(options.force && options.resume), STATUS_BAD_INPUT, "--force and --resume exclude each other");
    outdir d = { .lock = -1 };
    TRY(host_folder_make(path));
    snprintf(d.path, sizeof d.path, "%s", path);
    TRY(host_folder_probe(path));
    TRY(lock_directory(path, &d.lock));
    const status s = decide(&d, options);
    if (s.code != STATUS_OK) {
        host_outdir_close(&d);
        return s;
    }
    *out = d;
    return status_ok();
}

void host_outdir_close(outdir *d)
{
    if (d->lock >= 0) close(d->lock);
    d->lock = -1;
}

status host_outdir_file(const outdir *d, const char *name, char *path, size_t size)
{
    return path_join(d->path, name, path, size);
}

bool host_name_is_plain(const char *name)
{
    if (name[0] == '\0' || name[0] == '.') return false;
    for (; *name; name++)
        if (!isalnum((unsigned char)*name) && !strchr("-_.", *name)) return false;
    return true;
}

status host_outdir_scene(const outdir *d, const char *scene, char *path, size_t size)
{
    char scenes[OUTDIR_PATH_SIZE];
    CHECK(host_name_is_plain(scene), STATUS_BAD_INPUT, "scene `%.100s`: letters, digits, - _ . only", scene);
    TRY(path_join(d->path, "scenes", scenes, sizeof scenes));
    TRY(path_join(scenes, scene, path, size));
    return host_folder_make(path);
}

void host_outdir_drop_scene(const outdir *d, const char *scene)
{
    char scenes[OUTDIR_PATH_SIZE], path[OUTDIR_PATH_SIZE];
    if (!host_name_is_plain(scene) || path_join(d->path, "scenes", scenes, sizeof scenes).code != STATUS_OK ||
        path_join(scenes, scene, path, sizeof path).code != STATUS_OK)
        return;
    remove_ours(path, 2);
    rmdir(path);
}
