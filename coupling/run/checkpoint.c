/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/checkpoint.h"

#include "coupling/host/outdir.h"
#include "coupling/host/version.h"
#include "coupling/output/summary.h"
#include "coupling/run/scene_key.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The file: head, study bytes, image bytes.  The head's sum covers the head (with its sum zero), then both bodies, so
 * no byte of the file is outside it.  Native byte order: a checkpoint is not carried to another architecture, and the
 * magic number reads wrong there. */
#define MAGIC UINT64_C(0x3150434843454552) /* "REECHCP1" */

typedef struct {
    uint64_t magic, sum, bytes;
    checkpoint_key key;
    char scene[128];
    uint64_t scene_hash, study_bytes, image_bytes;
    double scene_time, wall_seconds;
} head;

static uint64_t sum_of(const head *h, const void *study, const void *image)
{
    head blank = *h;
    blank.sum = 0;
    uint64_t sum = host_hash_bytes(0, &blank, sizeof blank);
    sum = host_hash_bytes(sum, study, (size_t)h->study_bytes);
    return host_hash_bytes(sum, image, (size_t)h->image_bytes);
}

checkpoint_key run_checkpoint_key_of(const char *instruction_set, uint64_t inputs)
{
    checkpoint_key key;
    memset(&key, 0, sizeof key); /* padding too: the key is compared and summed as bytes */
    snprintf(key.version, sizeof key.version, "%s, solver %s", host_version(), run_solver_id());
    snprintf(key.instruction_set, sizeof key.instruction_set, "%s", instruction_set);
    key.inputs = inputs;
    return key;
}

status run_checkpoint_write(const char *path, const checkpoint_key *key, const checkpoint *c)
{
    head h;
    memset(&h, 0, sizeof h);
    h.magic = MAGIC;
    h.key = *key;
    h.bytes = sizeof h + c->study_bytes + c->image_bytes;
    snprintf(h.scene, sizeof h.scene, "%s", c->scene);
    h.scene_hash = c->scene_hash;
    h.scene_time = c->scene_time;
    h.wall_seconds = c->wall_seconds;
    h.study_bytes = c->study_bytes;
    h.image_bytes = c->image_bytes;
    h.sum = sum_of(&h, c->study, c->image);

    file_writer w;
    TRY(host_file_begin(&w, path));
    const bool written = fwrite(&h, sizeof h, 1, w.stream) == 1 &&
                         (c->study_bytes == 0 || fwrite(c->study, 1, c->study_bytes, w.stream) == c->study_bytes) &&
                         (c->image_bytes == 0 || fwrite(c->image, 1, c->image_bytes, w.stream) == c->image_bytes);
    if (!written) {
        const int error = errno;
        host_file_end(&w, false);
        return base_status_error(STATUS_IO, "%.300s: the checkpoint cannot be written: %s", path, strerror(error));
    }
    return host_file_end(&w, true);
}

static status check_key(const char *path, const checkpoint_key *had, const checkpoint_key *want)
{
    CHECK(
        strncmp(had->version, want->version, sizeof had->version) == 0, STATUS_BAD_INPUT,
        "%.200s: was written by version %.31s, this is %.31s: go on with the program that wrote it, or start over with "
        "--force",
        path, had->version, want->version);
    CHECK(strncmp(had->instruction_set, want->instruction_set, sizeof had->instruction_set) == 0, STATUS_BAD_INPUT,
          "%.200s: was written with the instruction set %.31s, this run uses %.31s; pin the former or start over with "
          "--force",
          path, had->instruction_set, want->instruction_set);
    CHECK(had->inputs == want->inputs, STATUS_BAD_INPUT,
          "%.200s: belongs to another case or other settings; give the same case and --set, or start over with --force",
          path);
    return status_ok();
}

static status copy_part(const char *from, uint64_t bytes, const void **to)
{
    *to = NULL;
    if (bytes == 0) return status_ok();
    void *copy = malloc((size_t)bytes);
    CHECK(copy, STATUS_MEMORY, "no memory for %llu bytes of the checkpoint", (unsigned long long)bytes);
    memcpy(copy, from, (size_t)bytes);
    *to = copy;
    return status_ok();
}

static status unpack(const char *path, const char *data, size_t bytes, const checkpoint_key *key, checkpoint *out)
{
    head h;
    CHECK(bytes >= sizeof h, STATUS_BAD_INPUT, "%.300s: is not a checkpoint of Breech (%zu bytes)", path, bytes);
    memcpy(&h, data, sizeof h);
    CHECK(h.magic == MAGIC, STATUS_BAD_INPUT, "%.300s: is not a checkpoint of Breech", path);
    CHECK(h.bytes == bytes && h.study_bytes <= bytes && h.image_bytes <= bytes &&
              sizeof h + h.study_bytes + h.image_bytes == bytes,
          STATUS_BAD_INPUT, "%.300s: is damaged: %zu bytes where %llu are due; start over with --force", path, bytes,
          (unsigned long long)h.bytes);
    const char *study = data + sizeof h, *image = study + h.study_bytes;
    CHECK(sum_of(&h, study, image) == h.sum, STATUS_BAD_INPUT,
          "%.300s: is damaged: its checksum is wrong; start over with --force", path);
    TRY(check_key(path, &h.key, key));

    memset(out, 0, sizeof *out);
    h.scene[sizeof h.scene - 1] = '\0';
    snprintf(out->scene, sizeof out->scene, "%s", h.scene);
    out->scene_hash = h.scene_hash;
    out->scene_time = h.scene_time;
    out->wall_seconds = h.wall_seconds;
    out->study_bytes = (size_t)h.study_bytes;
    out->image_bytes = (size_t)h.image_bytes;
    TRY(copy_part(study, h.study_bytes, &out->study));
    return copy_part(image, h.image_bytes, &out->image);
}

status run_checkpoint_read(const char *path, const checkpoint_key *key, checkpoint *out)
{
    memset(out, 0, sizeof *out);
    char *data;
    size_t bytes;
    TRY(host_file_read(path, &data, &bytes));
    const status s = unpack(path, data, bytes, key, out);
    free(data);
    if (s.code != STATUS_OK) run_checkpoint_free(out);
    return s;
}

void run_checkpoint_free(checkpoint *c)
{
    free((void *)c->study);
    free((void *)c->image);
    memset(c, 0, sizeof *c);
}
