/* SPDX-License-Identifier: BSD-3-Clause */
/* What a study notes of its work besides scenes: by name, bytes that grow. */
#include "coupling/run/session.h"

#include <stdlib.h>
#include <string.h>

static session_note *find(const session *s, const char *name)
{
    for (int i = 0; i < s->n_notes; i++)
        if (strcmp(s->note[i].name, name) == 0) return &s->note[i];
    return NULL;
}

const session_note *run_session_note(const session *s, const char *name)
{
    return find(s, name);
}

static status find_or_make(session *s, const char *name, session_note **out)
{
    *out = find(s, name);
    if (*out) return status_ok();
    session_note *more = realloc(s->note, ((size_t)s->n_notes + 1) * sizeof *more);
    CHECK(more, STATUS_MEMORY, "no memory for %d notes", s->n_notes + 1);
    s->note = more;
    *out = &more[s->n_notes++];
    **out = (session_note){ .bytes = 0 };
    snprintf((*out)->name, sizeof(*out)->name, "%s", name);
    return status_ok();
}

status run_session_note_append(session *s, const char *name, const void *bytes, size_t n)
{
    session_note *note;
    TRY(find_or_make(s, name, &note));
    char *data = realloc(note->data, note->bytes + n + 1);
    CHECK(data, STATUS_MEMORY, "no memory for a note of %zu bytes", note->bytes + n);
    memcpy(data + note->bytes, bytes, n);
    note->data = data;
    note->bytes += n;
    data[note->bytes] = '\0';
    return status_ok();
}

void run_session_note_drop(session *s, const char *beginning)
{
    for (int i = s->n_notes - 1; i >= 0; i--) {
        if (strncmp(s->note[i].name, beginning, strlen(beginning)) != 0) continue;
        free(s->note[i].data);
        s->note[i] = s->note[--s->n_notes];
    }
}

/* ---- in the checkpoint: of each its name, how many bytes, these ---- */

typedef struct {
    char name[SUMMARY_NAME_SIZE];
    uint64_t bytes;
} note_head;

status run_session_notes_pack(const session *s, char **out, size_t *bytes)
{
    *bytes = 0;
    for (int i = 0; i < s->n_notes; i++) *bytes += sizeof(note_head) + s->note[i].bytes;
    char *at = *out = malloc(*bytes + 1);
    CHECK(at, STATUS_MEMORY, "no memory for %d notes", s->n_notes);
    for (int i = 0; i < s->n_notes; i++) {
        note_head head = { .bytes = s->note[i].bytes };
        memcpy(head.name, s->note[i].name, sizeof head.name);
        memcpy(at, &head, sizeof head);
        memcpy(at + sizeof head, s->note[i].data, s->note[i].bytes);
        at += sizeof head + s->note[i].bytes;
    }
    return status_ok();
}

status run_session_notes_unpack(session *s, const char *from, size_t bytes, size_t notes)
{
    for (size_t i = 0; i < notes; i++) {
        note_head head;
        CHECK(bytes >= sizeof head, STATUS_IO, "the checkpoint's notes are of another build; start over with --force");
        memcpy(&head, from, sizeof head);
        from += sizeof head, bytes -= sizeof head;
        head.name[sizeof head.name - 1] = '\0';
        CHECK(bytes >= head.bytes, STATUS_IO, "the checkpoint's notes are of another build; start over with --force");
        TRY(run_session_note_append(s, head.name, from, (size_t)head.bytes));
        from += head.bytes, bytes -= head.bytes;
    }
    return status_ok();
}
