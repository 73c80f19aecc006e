/* SPDX-License-Identifier: BSD-3-Clause */
/* What the processes of a crew say to each other. */
#ifndef BREECH_COUPLING_CREW_MESSAGES_H
#define BREECH_COUPLING_CREW_MESSAGES_H

#include "coupling/output/summary.h"
#include "coupling/scene/scene_shelf.h"

#include <stdint.h>

enum {
    SAY_SCENE,  /* to a member: scene_order, then the key's text; it puts off what it is computing */
    SAY_DONE,   /* from a member: scene_answer, then the scene's file */
    SAY_FAILED, /* from a member: scene_answer, then a status */
    SAY_FILE,   /* from a member: a path under the output directory, a 0, the bytes */
    SAY_DROP,   /* to a member: the key's hash: give that scene up, if it is under way or put off; it says SAY_FAILED */
    SAY_STOP,   /* to a member: give up all of them */
    SAY_END     /* to a member: nothing more comes; and its answer, the last it says */
};

typedef struct {
    uint64_t key;
    char name[SUMMARY_NAME_SIZE];
} scene_order;

typedef struct {
    uint64_t key;
    uint64_t shelf[SCENE_SHELF_ROOM]; /* twins of what the member could go on from now */
} scene_answer;

/* A head and a body as one message. */
status run_crew_say(int to, int kind, const void *head, size_t head_bytes, const void *body, size_t body_bytes);

#endif
