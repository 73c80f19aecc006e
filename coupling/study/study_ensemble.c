/* SPDX-License-Identifier: BSD-3-Clause */
/* breech scene with study.ensemble: ensemble.h as a study, of a scene of any kind. */
#include "coupling/study/ensemble.h"

#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/scene/scene_window.h"
#include "coupling/study/scene_doubts.h"

#include <stdlib.h>
#include <string.h>

/* ---- keys ---- */

static const summary_key scene_keys[] = {
    SUMMARY_TEXT(ensemble_scene, "scene", scene, "its name"),
    SUMMARY_VECTOR(ensemble_scene, "grid_shift", shift, 3, "1", "of its grid along x, y, z, in finest cells"),
    SUMMARY_TEXT(ensemble_scene, "class", class, "as that of `scene`; empty: a scene of bodies"),
    SUMMARY_PAIRS(ensemble_scene, "values", value, n_values, "number of its summary: its value"),
    SUMMARY_NUMBER(ensemble_scene, "wall_seconds", wall_seconds, "s",
                   "time it took, in the store's run if it is from there"),
    SUMMARY_END,
};

static const summary_key number_keys[] = {
    SUMMARY_TEXT(ensemble_number, "name", name, "of the number"),
    SUMMARY_TEXT(ensemble_number, "unit", unit, "its unit"),
    SUMMARY_NUMBER(ensemble_number, "mean", spread.mean, "", "of the scenes that have it"),
    SUMMARY_NUMBER(ensemble_number, "deviation", spread.deviation, "",
                   "standard deviation, by n - 1; null: fewer than two scenes have it"),
    SUMMARY_NUMBER(ensemble_number, "least", spread.least, "", "smallest"),
    SUMMARY_NUMBER(ensemble_number, "largest", spread.largest, "", "largest"),
    SUMMARY_VALUE(ensemble_number, KEY_INTEGER, "scenes", spread.scenes, "1", "that have it"),
    SUMMARY_END,
};

static const summary_key result_keys[] = {
    SUMMARY_TEXT(ensemble_result, "of", of, "the study that was run on every grid: scene, bodies"),
    SUMMARY_PAIRS(ensemble_result, "classes", class, n_classes, "class: how many scenes have it"),
    SUMMARY_MAP(ensemble_result, "numbers", number, n_numbers, number_keys, sizeof(ensemble_number),
                "each number of the scene's summary by its name, of vectors every component, keys below"),
    SUMMARY_LIST(ensemble_result, "scenes", scene, n_scenes, scene_keys, sizeof(ensemble_scene),
                 "a scene each, the first on the case's own grid, keys below"),
    SUMMARY_NUMBER(ensemble_result, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_END,
};

/* ---- the answer ---- */

enum { MOST_CLASSES = 8 };

typedef struct {
    ensemble_result result; /* borrows the rest */
    const study *of;
    int scenes, numbers;
    case_inputs *in;      /* [scenes] the case's, each with its shift; owned, as all that follows, what they hold not */
    study_answer *answer; /* [scenes] */
    char (*prefix)[16];   /* [scenes] */
    ensemble_scene *scene;
    ensemble_number *number; /* [numbers] */
    double *value;           /* [numbers][scenes] */
    summary_pair *pair;      /* [scenes][numbers] */
    summary_pair class[MOST_CLASSES];
} ensemble_answer;

static void answer_free(void *owned)
{
    ensemble_answer *a = owned;
    if (!a) return;
    for (int i = 0; a->answer && i < a->scenes; i++)
        if (a->of->free) a->of->free(a->answer[i].owned);
    void *const all[] = { a->in, a->answer, a->prefix, a->scene, a->number, a->value, a->pair, a };
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) free(all[k]);
}

static bool asked_for(const case_inputs *in)
{
    return in->onset.study.ensemble > 0;
}

static status make_room(const case_inputs *in, ensemble_answer *a)
{
    const size_t n = (size_t)in->onset.study.ensemble;
    a->in = calloc(n, sizeof *a->in);
    a->answer = calloc(n, sizeof *a->answer);
    a->prefix = calloc(n, sizeof *a->prefix);
    a->scene = calloc(n, sizeof *a->scene);
    CHECK(a->in && a->answer && a->prefix && a->scene, STATUS_MEMORY, "no memory for an ensemble of %zu scenes", n);
    a->scenes = (int)n;
    return status_ok();
}

static double *shift_of(case_inputs *in)
{
    return in->given.bodies ? in->bodies.scene.grid_shift : in->onset.impact.scene.grid_shift;
}

/* The case on every grid. */
static void fill_cases(const study_case *of, ensemble_answer *a)
{
    for (int i = 0; i < a->scenes; i++) {
        case_inputs own = *of->in;
        a->in[i] = own;
        a->in[i].onset.study.ensemble = 0;
        study_shift_of(i, shift_of(&own), shift_of(&a->in[i]));
        if (own.given.bodies) scene_window_limit_shift(&a->in[i].bodies.scene, own.bodies.scene.grid_shift);
        memcpy(a->scene[i].shift, shift_of(&a->in[i]), sizeof a->scene[i].shift);
        snprintf(a->prefix[i], sizeof a->prefix[i], "e%d-", i + 1);
    }
    a->of = study_for(&study_scene, &a->in[0]);
    snprintf(a->result.of, sizeof a->result.of, "%s", a->of->name);
}

static study_case case_of_scene(const ensemble_answer *a, int i)
{
    return (study_case){ .in = &a->in[i], .one_of_several = true, .prefix = a->prefix[i] };
}

/* All at once: any process may take any of them. */
static status run_scenes(session *s, const ensemble_answer *a)
{
    scene_query *query = malloc((size_t)a->scenes * sizeof *query);
    const scene_record **record = malloc((size_t)a->scenes * sizeof *record);
    status done =
        query && record ? status_ok() : base_status_error(STATUS_MEMORY, "no memory for %d scenes", a->scenes);
    int n = 0;
    for (int i = 0; done.code == STATUS_OK && i < a->scenes; i++) {
        const study_case of = case_of_scene(a, i);
        n += a->of->scenes(&of, &query[n]);
        memcpy(a->scene[i].scene, query[i].name, sizeof a->scene[i].scene);
    }
    if (done.code == STATUS_OK) done = run_scenes_all(s, query, n, record);
    free(record);
    free(query);
    return done;
}

/* ---- its numbers ---- */

typedef struct {
    ensemble_answer *a;
    int scene, at;
} collector;

static void collect(void *user, const output_number *number)
{
    collector *c = user;
    ensemble_answer *a = c->a;
    if (number->counts || strcmp(number->path, "wall_seconds") == 0) return;
    const int at = c->at++;
    if (!a->number || at >= a->numbers) return; /* they are counted first */
    ensemble_number *n = &a->number[at];
    if (c->scene == 0) {
        snprintf(n->name, sizeof n->name, "%s", number->path);
        snprintf(n->unit, sizeof n->unit, "%s", number->unit);
    }
    a->value[at * a->scenes + c->scene] = number->value;
    a->pair[c->scene * a->numbers + at] = (summary_pair){ .name = n->name, .value = number->value };
}

static int collect_scene(ensemble_answer *a, int scene)
{
    collector c = { .a = a, .scene = scene };
    output_numbers_visit(&(summary_object){ a->of->keys, a->answer[scene].result }, collect, &c);
    return c.at;
}

/* Of the class each scene has; none: such a scene has no class. */
static const summary_key *class_key(const study *y)
{
    const summary_key *k = y->keys;
    while (k->name && !(k->kind == KEY_NAME && strcmp(k->name, "class") == 0)) k++;
    return k->name ? k : NULL;
}

static void count_classes(ensemble_answer *a)
{
    const summary_key *key = class_key(a->of);
    for (int k = 0; key && key->names[k] && k < MOST_CLASSES; k++)
        a->class[a->result.n_classes++] = (summary_pair){ .name = key->names[k] };
    for (int i = 0; key && i < a->scenes; i++) {
        const char *result = a->answer[i].result;
        const int class = *(const int *)(const void *)(result + key->offset);
        snprintf(a->scene[i].class, sizeof a->scene[i].class, "%s", key->names[class]);
        if (class < a->result.n_classes) a->class[class].value += 1.0;
    }
}

static status fill_numbers(ensemble_answer *a)
{
    const int numbers = collect_scene(a, 0);
    const size_t n = (size_t)numbers, scenes = (size_t)a->scenes;
    ensemble_number *number = calloc(n + 1, sizeof *number);
    a->value = calloc(n * scenes + 1, sizeof *a->value);
    a->pair = calloc(n * scenes + 1, sizeof *a->pair);
    a->number = number;
    CHECK(number && a->value && a->pair, STATUS_MEMORY, "no memory for %zu numbers", n * scenes);
    a->numbers = numbers;
    for (int i = 0; i < a->scenes; i++) {
        const int found = collect_scene(a, i);
        CHECK(found == numbers, STATUS_NUMERICAL, "scene %s: %d numbers, the first scene has %d", a->scene[i].scene,
              found, numbers);
        a->scene[i].n_values = numbers;
        a->scene[i].value = a->pair + i * numbers;
        a->scene[i].wall_seconds =
            output_number_of(&(summary_object){ a->of->keys, a->answer[i].result }, "wall_seconds", NULL);
    }
    for (int k = 0; k < numbers; k++) number[k].spread = study_shift_spread(a->value + k * a->scenes, a->scenes);
    count_classes(a);
    return status_ok();
}

/* ---- the whole ---- */

static status ensemble(session *s, const study_case *of, ensemble_answer *a)
{
    TRY(make_room(of->in, a));
    fill_cases(of, a);
    TRY(run_scenes(s, a));
    for (int i = 0; i < a->scenes; i++) {
        const study_case one = case_of_scene(a, i);
        TRY(a->of->run(s, &one, &a->answer[i]));
    }
    TRY(fill_numbers(a));
    ensemble_result *r = &a->result;
    r->n_scenes = a->scenes, r->scene = a->scene;
    r->n_numbers = a->numbers, r->number = a->number;
    r->class = a->class;
    return status_ok();
}

static status run(session *s, const study_case *of, study_answer *out)
{
    ensemble_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an ensemble");
    study_scene_doubts_warn(s, of);
    TRY(ensemble(s, of, a));
    a->result.wall_seconds = run_session_wall(s);
    out->result = &a->result;
    return status_ok();
}

/* ---- for people ---- */

static void print_scenes(const ensemble_result *r, FILE *out)
{
    table *t;
    if (host_table_create("scene|shift of the grid [cells]|class|time [s]", &t).code != STATUS_OK) return;
    for (int i = 0; i < r->n_scenes; i++) {
        const ensemble_scene *e = &r->scene[i];
        char time[24];
        host_table_row(t, "%s|%.3f %.3f %.3f|%s|%s", e->scene, e->shift[0], e->shift[1], e->shift[2], e->class,
                       output_cell(e->wall_seconds, 1.0, "%.1f", time));
    }
    host_table_print(t, out);
    host_table_free(t);
}

static void print(const void *result, FILE *out)
{
    const ensemble_result *r = result;
    table *t;
    print_scenes(r, out);
    if (host_table_create("number|mean|deviation|smallest|largest|unit|scenes", &t).code != STATUS_OK) return;
    for (int k = 0; k < r->n_numbers; k++) {
        const ensemble_number *n = &r->number[k];
        const shift_spread *s = &n->spread;
        char mean[24], deviation[24], least[24], largest[24];
        if (s->scenes == 0) continue;
        host_table_row(t, "%s|%s|%s|%s|%s|%s|%d", n->name, output_cell(s->mean, 1.0, "%.5g", mean),
                       output_cell(s->deviation, 1.0, "%.2g", deviation), output_cell(s->least, 1.0, "%.5g", least),
                       output_cell(s->largest, 1.0, "%.5g", largest), strcmp(n->unit, "1") == 0 ? "" : n->unit,
                       s->scenes);
    }
    fputc('\n', out);
    host_table_print(t, out);
    host_table_free(t);
}

const study study_ensemble = {
    .name = "ensemble",
    .doc = "breech scene of a case with study.ensemble",
    .more = "",
    .takes = asked_for,
    .instead = &study_bodies,
    .needs = CASE_FOR_SCENE,
    .keys = result_keys,
    .report = { report_ensemble_head, report_ensemble_section },
    .print = print,
    .run = run,
    .free = answer_free,
};
