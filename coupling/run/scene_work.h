/* SPDX-License-Identifier: BSD-3-Clause */
/* One scene computed for a query, whichever process does it. */
#ifndef BREECH_COUPLING_SCENE_WORK_H
#define BREECH_COUPLING_SCENE_WORK_H

#include "coupling/run/lending.h"
#include "coupling/run/scenes.h"
#include "coupling/run/store.h"

typedef struct {
    impact_runner run;
    const char *task; /* for people */
    const scene_host *host;
    lending *lending; /* NULL: none */
    scene_resume resume;
} scene_work_how;

status run_scene_query_key(const scene_query *q, scene_key *out); /* *out needs run_scene_key_free even on error */
/* What the query says of its scene; the result is empty. */
scene_record run_scene_record(const scene_query *q);
/* The same for a scene to its gauge and for the whole one (impact_job); 0: it has no gauges. */
status run_scene_twin(const scene_query *q, uint64_t *twin);
/* STATUS_STOPPED and errors as the runner. */
status run_scene_work(const scene_query *q, uint64_t key, const scene_work_how *how, scene_record *out);

#endif
