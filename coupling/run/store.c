/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/store.h"
#include "coupling/host/hash.h"
#include "coupling/host/version.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FORMAT "breech scene 2"

enum { TEXT_SIZE = 1 << 16 }; /* an attribute holds no more */

/* ---- the file of one scene ---- */

/* Of any scene; of one of bodies the result lies by its series. */
static status put_names(h5_file *f)
{
    const char *const texts[][2] = { { "format", FORMAT },
                                     { "version", host_version() },
                                     { "instruction_set", mpm_instruction_set() },
                                     { "solver", run_solver_id() } };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        TRY(host_h5_attribute_text(f, "/", texts[i][0], texts[i][1]));
    return status_ok();
}

static status put_outcome(h5_file *f, const scene_record *r, const scene_key *key)
{
    char *outcome = output_object_text(&(summary_object){ run_scene_keys, &r->entry });
    CHECK(outcome, STATUS_MEMORY, "no memory for a scene's outcome");
    status done = host_h5_attribute_text(f, "/", "case", key->text);
    if (done.code == STATUS_OK) done = host_h5_attribute_text(f, "/", "outcome", outcome);
    free(outcome);
    TRY(done);
    TRY(host_h5_attribute_double(f, "/", "impulse_N_s", r->impulse));
    return host_h5_attribute_double(f, "/", "mass_loss_kg", r->mass_loss);
}

static status fill(h5_file *f, const scene_record *r, const scene_key *key, history *h)
{
    TRY(put_names(f));
    TRY(r->of_bodies ? host_h5_write_text(f, "/case", "the key: a case file of this scene", key->text)
                     : put_outcome(f, r, key));
    return h && output_history_has(h, r->entry.name) ? output_history_export(h, r->entry.name, f) : status_ok();
}

status run_scene_file_make(const scene_record *r, const scene_key *key, history *h, h5_file **out)
{
    TRY(host_h5_create(out));
    const status done = fill(*out, r, key, h);
    if (done.code != STATUS_OK) {
        host_h5_close(*out);
        *out = NULL;
    }
    return done;
}

static status read_with(const h5_file *f, const scene_key *key, scene_record *out, char *text)
{
    TRY(host_h5_read_attribute_text(f, "/", "case", text, TEXT_SIZE));
    CHECK(strcmp(text, key->text) == 0, STATUS_IO, "the store's scene %016llx has other inputs",
          (unsigned long long)key->hash);
    TRY(host_h5_read_attribute_text(f, "/", "outcome", text, TEXT_SIZE));
    TRY(output_object_read(text, run_result_keys, &out->entry.result));
    TRY(host_h5_read_attribute_double(f, "/", "impulse_N_s", &out->impulse));
    TRY(host_h5_read_attribute_double(f, "/", "mass_loss_kg", &out->mass_loss));
    out->key = key->hash;
    return status_ok();
}

static status read_bodies(const h5_file *f, const scene_key *key, scene_record *out)
{
    char *text;
    TRY(host_h5_read_text(f, "/case", &text));
    const bool same = strcmp(text, key->text) == 0;
    free(text);
    CHECK(same && host_h5_exists(f, "/scene/result"), STATUS_IO, "the store's scene %016llx has other inputs",
          (unsigned long long)key->hash);
    out->key = key->hash;
    return status_ok();
}

status run_scene_file_read(const h5_file *f, const scene_key *key, scene_record *out)
{
    if (host_h5_exists(f, "/case")) return read_bodies(f, key, out);
    char *text = malloc(TEXT_SIZE);
    CHECK(text, STATUS_MEMORY, "no memory to read a scene");
    const status done = read_with(f, key, out, text);
    free(text);
    return done;
}

/* ---- where they lie ---- */

static status path_of(const char *dir, const scene_key *key, char path[OUTDIR_PATH_SIZE])
{
    const int n = snprintf(path, OUTDIR_PATH_SIZE, "%s/%016llx.h5", dir, (unsigned long long)key->hash);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE - 100, STATUS_BAD_INPUT, "store %.200s...: the path is too long", dir);
    return status_ok();
}

/* What this process calls a file until it is whole: path.<host>-<pid>. */
static void host_of(char name[64])
{
    memset(name, 0, 64);
    gethostname(name, 63);
}

/* Of a process of this machine that was killed while it wrote. */
static bool is_left_over(const char *name, const char *host)
{
    enum { KEY = 16 };
    const size_t length = strlen(host);
    if (strlen(name) < KEY + 4 + length || strspn(name, "0123456789abcdef") != KEY) return false;
    if (strncmp(name + KEY, ".h5.", 4) != 0 || strncmp(name + KEY + 4, host, length) != 0) return false;
    const char *pid = name + KEY + 4 + length;
    return pid[0] == '-' && pid[1] >= '1' && pid[1] <= '9' && kill((pid_t)atol(pid + 1), 0) != 0 && errno == ESRCH;
}

static void remove_left_over(const char *dir)
{
    char host[64], path[OUTDIR_PATH_SIZE];
    DIR *d = opendir(dir);
    if (!d) return;
    host_of(host);
    for (const struct dirent *e; (e = readdir(d));)
        if (is_left_over(e->d_name, host) && snprintf(path, sizeof path, "%s/%s", dir, e->d_name) < (int)sizeof path)
            unlink(path);
    closedir(d);
}

status run_store_open(const char *dir)
{
    TRY(host_folder_make(dir));
    TRY(host_folder_probe(dir));
    remove_left_over(dir);
    return status_ok();
}

/* ---- the seal: the file's last bytes, a hash over all bytes before them.  HDF5 does not look behind its own end. */

#define MAGIC UINT64_C(0x4c41455348434252) /* "RBCHSEAL" */

typedef struct {
    uint64_t magic, sum;
} seal;

static seal seal_of(const void *image, size_t bytes)
{
    return (seal){ MAGIC, host_hash_bytes(MAGIC, image, bytes) };
}

static status write_sealed(const char *path, h5_file *file)
{
    const void *image;
    size_t bytes;
    TRY(host_h5_image(file, &image, &bytes));
    char *all = malloc(bytes + sizeof(seal));
    CHECK(all, STATUS_MEMORY, "%.300s: no memory for %zu bytes", path, bytes);
    const seal last = seal_of(image, bytes);
    memcpy(all, image, bytes);
    memcpy(all + bytes, &last, sizeof last);
    const status done = host_file_write(path, all, bytes + sizeof last);
    free(all);
    return done;
}

static status open_sealed(const char *path, const char *all, size_t bytes, h5_file **out)
{
    seal last = { 0, 0 };
    if (bytes > sizeof last) memcpy(&last, all + bytes - sizeof last, sizeof last);
    CHECK(last.magic == MAGIC && last.sum == seal_of(all, bytes - sizeof last).sum, STATUS_IO,
          "%.300s: is damaged: its checksum is wrong", path);
    return host_h5_open_image(path, all, bytes - sizeof last, out);
}

status run_store_get(const char *dir, const scene_key *key, h5_file **out)
{
    char path[OUTDIR_PATH_SIZE], *all;
    size_t bytes;
    *out = NULL;
    TRY(path_of(dir, key, path));
    if (!host_file_exists(path)) return status_ok();
    TRY(host_file_read(path, &all, &bytes));
    const status done = open_sealed(path, all, bytes, out);
    free(all);
    return done;
}

bool run_store_has(const char *dir, const scene_key *key)
{
    char path[OUTDIR_PATH_SIZE];
    return path_of(dir, key, path).code == STATUS_OK && host_file_exists(path);
}

status run_store_check(const char *dir, const scene_key *key)
{
    char path[OUTDIR_PATH_SIZE];
    TRY(path_of(dir, key, path));
    CHECK(!host_folder_exists(path), STATUS_BAD_INPUT,
          "%.300s: is a folder where the store keeps a scene: remove it, or name another --store", path);
    return status_ok();
}

/* Under a name of its own first: another program may be writing the same scene. */
status run_store_put(const char *dir, const scene_key *key, h5_file *file)
{
    char path[OUTDIR_PATH_SIZE], own[OUTDIR_PATH_SIZE + 100], host[64];
    TRY(path_of(dir, key, path));
    TRY(host_folder_make(dir));
    host_of(host);
    snprintf(own, sizeof own, "%s.%s-%ld", path, host, (long)getpid());
    TRY(write_sealed(own, file));
    if (rename(own, path) == 0) return status_ok();
    const int error = errno;
    unlink(own);
    return base_status_error(STATUS_IO, "%.300s: cannot be written: %s", path, strerror(error));
}
