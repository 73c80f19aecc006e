/* SPDX-License-Identifier: BSD-3-Clause */
/* The scene store: what decides a scene, its file, and that no scene is computed twice, whoever else is at it. */
#include "coupling/case/case.h"
#include "coupling/gouge/impact_scene.h"
#include "coupling/run/scenes.h"
#include "coupling/run/store.h"

#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "status_common.h"

#include "body_scenes.h"

#define CASES BREECH_TESTS "/../cases"

static breech_case *read_case(const char *const *sets)
{
    const char *const dirs[] = { CASES "/materials" };
    const case_options how = { dirs, 1, CASE_FOR_ONSET };
    breech_case *c = NULL;
    char *errors = NULL;
    int n = 0;
    while (sets && sets[n]) n++;
    const status s = case_read(CASES "/default_shot", sets, n, &how, &c, &errors);
    if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
    return c;
}

static site_state state_at(const breech_case *c, double velocity)
{
    return (site_state){ .grain = c->sites.item[0],
                         .reached = true,
                         .velocity = velocity,
                         .contact_pressure = 75e6,
                         .lead_face_temperature = 300.0 };
}

static case_impact impact_at(const breech_case *c, double velocity, double cells)
{
    const case_impact from = case_inputs_of(c).onset.impact;
    const site_state state = state_at(c, velocity);
    return gouge_impact_at(&from, &state, cells);
}

static uint64_t key_at(const breech_case *c, double velocity, double cells)
{
    const case_impact one = impact_at(c, velocity, cells);
    scene_key key;
    OK(run_scene_key_of(&one, &key));
    const uint64_t hash = key.hash;
    run_scene_key_free(&key);
    return hash;
}

/* ---- the key ---- */

/* Whatever decides the scene changes the key; what does not, does not. */
static void test_key_parts(void **state)
{
    (void)state;
    breech_case *c = read_case(NULL);
    const uint64_t base = key_at(c, 1500.0, 3.0);
    assert_true(key_at(c, 1500.0, 3.0) == base);
    assert_true(key_at(c, 1510.0, 3.0) != base);
    assert_true(key_at(c, 1500.0, 3.5) != base);
    const char *const decides[] = { "scene.friction=0.19",    "scene.courant=0.3",          "rail.yield_scale=1.01",
                                    "rail.temperature=294 K", "armature.length=0.03 m",     "scene.limit_severity=0.1",
                                    "output.snapshots=7",     "sites[0].radius=0.6 mm",     "scene.damage=no",
                                    "sites[0].shape=cone",    "armature.lead_angle=0.5 rad" };
    for (size_t i = 0; i < sizeof decides / sizeof *decides; i++) {
        breech_case *other = read_case((const char *const[]){ decides[i], NULL });
        if (key_at(other, 1500.0, 3.0) == base) fail_msg("%s does not change the key", decides[i]);
        case_free(other);
    }
    const char *const idle[] = { "bank[0].charge=8 kV", "study.max_scenes=30",       "scene.velocity=1700 m/s",
                                 "title=another",       "scene.cells_per_radius=9",  "output.checkpoint_interval=2 s",
                                 "name=other",          "sites[1].position=0.123 m", "scene.contact_pressure=1 MPa" };
    for (size_t i = 0; i < sizeof idle / sizeof *idle; i++) {
        breech_case *other = read_case((const char *const[]){ idle[i], NULL });
        if (key_at(other, 1500.0, 3.0) != base) fail_msg("%s changes the key", idle[i]);
        case_free(other);
    }
    assert_true(isnan(c->projectile.temperature)); /* the shot's, which has been told */
    for (int warmer = 0; warmer < 2; warmer++) {
        breech_case *warm = read_case(
            (const char *const[]){ warmer ? "armature.temperature=305 K" : "armature.temperature=300 K", NULL });
        assert_true((key_at(warm, 1500.0, 3.0) == base) == !warmer);
        case_free(warm);
    }
    mpm_material *copper = (mpm_material *)case_material(&c->materials, c->rail.material);
    copper->damage_D1 = nextafter(copper->damage_D1, INFINITY); /* the last bit of one constant */
    assert_true(key_at(c, 1500.0, 3.0) != base);
    case_free(c);
}

/* The key's text is a case file of this scene alone: read back it is the same scene. */
static void test_key_is_a_case(void **state)
{
    (void)state;
    const char *const sets[] = { "rail.temperature=311.3 K", "sites[0].bond_strength=123.4 MPa", NULL };
    breech_case *c = read_case(sets), *back = NULL;
    const case_impact one = impact_at(c, 1480.0 / 3.0 * 3.1, 3.7);
    scene_key key, again;
    char *errors = NULL;
    OK(run_scene_key_of(&one, &key));
    const case_text text = { .bytes = key.text, .length = key.bytes, .path = "key" };
    const status read = case_read_memory(&text, &(case_options){ .needs = CASE_FOR_SCENE }, &back, &errors);
    if (read.code != STATUS_OK) fail_msg("%s", errors ? errors : read.text);
    const case_impact one_back = case_inputs_of(back).onset.impact;
    OK(run_scene_key_of(&one_back, &again));
    assert_string_equal(key.text, again.text);
    assert_true(key.hash == again.hash);

    gouge_scene of_a, of_b;
    OK(gouge_scene_make(&one, &of_a));
    OK(gouge_scene_make(&one_back, &of_b));
    const mpm_scene a = of_a.scene, b = of_b.scene;
    assert_int_equal(a.bodies, b.bodies);
    for (int i = 0; i < a.bodies; i++) {
        assert_string_equal(a.body[i].name, b.body[i].name);
        const mpm_solid *solid_a = &a.solid[a.body[i].solid], *solid_b = &b.solid[b.body[i].solid];
        assert_ptr_equal(solid_a->kind, solid_b->kind);
        assert_memory_equal(solid_a->value, solid_b->value, sizeof solid_a->value);
        assert_true(a.body[i].body_force[1] == b.body[i].body_force[1]);
        assert_true(a.body[i].temperature == b.body[i].temperature);
    }
    assert_true(a.end_time == b.end_time && a.axis[0].fine_hi == b.axis[0].fine_hi);
    assert_true(of_a.crater.particle_volume == of_b.crater.particle_volume);
    gouge_scene_free(&of_a), gouge_scene_free(&of_b);
    run_scene_key_free(&key);
    run_scene_key_free(&again);
    case_free(back);
    case_free(c);
}

/* ---- the file ---- */

static scene_record some_record(void)
{
    scene_record r;
    memset(&r, 0, sizeof r);
    snprintf(r.entry.name, sizeof r.entry.name, "g1-v1500-c3");
    r.entry.velocity = 1500.0;
    scene_result *e = &r.entry.result;
    e->class = DAMAGE_SCRATCH;
    snprintf(e->reason, sizeof e->reason, "a \"quoted\" reason, 3 \\ 4");
    e->severity = -1.0 / 3.0;
    e->widening = NAN;
    e->peak_force[1] = -1e5 / 7.0;
    e->crater_truncated = true;
    e->bodies = 2;
    snprintf(e->body[0], sizeof e->body[0], "rail");
    snprintf(e->body[1], sizeof e->body[1], "armature");
    e->failed_volume[1] = 1e-10 / 3.0;
    e->particle_steps = 123456789012345u;
    e->wall_seconds = 0.1;
    e->threads = 2;
    r.impulse = 0.1 / 3.0;
    r.mass_loss = 1e-6 / 3.0;
    return r;
}

static void test_file(void **state)
{
    (void)state;
    breech_case *c = read_case(NULL);
    const case_impact one = impact_at(c, 1500.0, 3.0), finer = impact_at(c, 1500.0, 4.0);
    scene_record r = some_record(), back;
    scene_key key, other;
    OK(run_scene_key_of(&one, &key));
    OK(run_scene_key_of(&finer, &other));
    r.key = key.hash;
    h5_file *made, *f;
    const void *image;
    size_t bytes;
    OK(run_scene_file_make(&r, &key, NULL, &made));
    OK(host_h5_image(made, &image, &bytes));
    OK(host_h5_open_image("sent", image, bytes, &f)); /* as it goes from process to process */
    host_h5_close(made);
    memset(&back, 0, sizeof back);
    OK(run_scene_file_read(f, &key, &back));
    assert_true(isnan(back.entry.result.widening));
    back.entry.result.widening = r.entry.result.widening; /* one NaN need not have the other's bits */
    assert_memory_equal(&back.entry.result, &r.entry.result, sizeof r.entry.result);
    assert_true(back.impulse == r.impulse && back.mass_loss == r.mass_loss && back.key == r.key);
    assert_int_equal(run_scene_file_read(f, &other, &back).code, STATUS_IO); /* not the file of that scene */
    host_h5_close(f);
    run_scene_key_free(&key);
    run_scene_key_free(&other);
    case_free(c);
}

/* ---- sessions that share a store; scenes that cost nothing ---- */

static struct {
    int scenes;
} ran; /* the runner has no place for it */

static status fake_scene(const impact_job *job, const scene_host *host, impact *out)
{
    memset(out, 0, sizeof *out);
    ran.scenes++;
    const double v = job->of.scene.velocity;
    double row[HISTORY_MAX_COLUMNS] = { 0.0, v };
    int series;
    OK(output_history_scene(host->history, job->name, NULL, 0, &series));
    OK(output_history_append(host->history, series, row));
    OK(output_history_end(host->history, series));
    out->result.severity = v - 1500.0;
    out->result.class = v >= 1500.0 ? DAMAGE_GOUGE : DAMAGE_SCRATCH;
    out->impulse = 1e-5 * v;
    return status_ok();
}

static session opened_with(const breech_case *c, const char *dir, const char *store, bool force)
{
    session s;
    const session_options options = { .command = "onset",
                                      .dir = dir,
                                      .store = store,
                                      .how = { .force = force },
                                      .threads = 1,
                                      .progress_to = stderr,
                                      .quiet = true };
    const case_inputs in = case_inputs_of(c);
    OK(run_session_open(&in, &options, &s));
    s.run_scene = fake_scene;
    ran.scenes = 0;
    return s;
}

static session opened(const breech_case *c, const char *dir, const char *store)
{
    return opened_with(c, dir, store, false);
}

static scene_query query_at(const breech_case *c, double velocity, const char *name)
{
    scene_query q = { .impact = impact_at(c, velocity, 3.0) };
    snprintf(q.name, sizeof q.name, "%s", name);
    return q;
}

static void fresh_folder(const char *name)
{
    char command[200];
    snprintf(command, sizeof command, "rm -rf '%s'", name);
    assert_int_equal(system(command), 0);
}

static void test_shared(void **state)
{
    (void)state;
    fresh_folder("shared");
    breech_case *c = read_case(NULL);
    const scene_query q[] = { query_at(c, 1400.0, "a"), query_at(c, 1600.0, "b"), query_at(c, 1400.0, "c") };
    const scene_record *out[3];
    session s = opened(c, "shared/one", "shared/store");
    OK(run_scenes_all(&s, q, 3, out));
    assert_int_equal(ran.scenes, 2);
    assert_ptr_equal(out[0], out[2]); /* the same inputs are one scene, whatever its name */
    assert_true(out[0]->impulse == 1e-5 * 1400.0 && out[1]->entry.result.severity == 100.0);
    assert_false(out[0]->entry.reused);
    const scene_record first = *out[0];
    OK(run_session_close(&s, true));

    s = opened(c, "shared/two", "shared/store");
    const scene_query more[] = { query_at(c, 1600.0, "x"), query_at(c, 1500.0, "y"), query_at(c, 1400.0, "z") };
    OK(run_scenes_find(&s, &more[1], &out[1]));
    assert_null(out[1]);
    OK(run_scenes_some(&s, more, 3)); /* two of them are there already: it computes the third */
    assert_int_equal(ran.scenes, 1);
    OK(run_scenes_all(&s, more, 3, out));
    assert_int_equal(ran.scenes, 1);
    assert_true(out[2]->entry.reused && !out[1]->entry.reused);
    assert_string_equal(out[2]->entry.name, "z");
    assert_true(out[2]->impulse == first.impulse && out[2]->entry.result.severity == first.entry.result.severity);
    assert_true(output_history_has(s.history, "z")); /* its series came along */
    scene_query anew = more[2];
    anew.anew = true;
    OK(run_session_close(&s, true));

    s = opened(c, "shared/three", ""); /* no store */
    OK(run_scenes_all(&s, more, 3, out));
    assert_int_equal(ran.scenes, 3);
    OK(run_session_close(&s, true));
    assert_int_not_equal(access("shared/three/store", F_OK), 0);

    s = opened(c, "shared/four", "shared/store");
    OK(run_scenes_all(&s, &anew, 1, out));
    assert_int_equal(ran.scenes, 1);
    OK(run_session_close(&s, true));
    case_free(c);
}

static void path_in(const char *dir, uint64_t key, char path[300])
{
    snprintf(path, 300, "%s/%016llx.h5", dir, (unsigned long long)key);
}

/* Scenes of bodies: computed once, whatever run asks; result and series come from the store as they were; another
 * value, or another number of snapshots, is another scene. */
static void test_bodies(void **state)
{
    (void)state;
    fresh_folder("bodies");
    breech_case *c = read_case(NULL);
    case_inputs *coarse = body_scene("scene.cell=0.4 mm"), *again = body_scene("scene.cell=0.0004 m");
    case_inputs *other[] = { body_scene("scene.cell=0.5 mm"), body_scene("output.snapshots=3") };
    const scene_query q[] = { body_scene_query(coarse, "a"), body_scene_query(again, "b") };
    const scene_record *out[2];
    session one = opened(c, "bodies/one", "bodies/store");
    OK(run_scenes_all(&one, q, 2, out));
    assert_ptr_equal(out[0], out[1]); /* two cases, one scene */
    assert_true(out[0]->of_bodies && !out[0]->entry.reused);
    assert_string_equal(out[0]->entry.name, "a");
    assert_int_equal(one.n_records, 1);
    char *want = body_scene_result(one.history, "a");
    for (int i = 0; i < 2; i++) {
        const scene_query different = body_scene_query(other[i], "d");
        OK(run_scenes_find(&one, &different, &out[1]));
        assert_null(out[1]);
    }

    session two = opened(c, "bodies/two", "bodies/store");
    OK(run_scenes_all(&two, &q[1], 1, out));
    assert_true(out[0]->entry.reused);
    char *have = body_scene_result(two.history, "b");
    assert_string_equal(have, want);
    assert_same_body_series(one.history, "a", two.history, "b");
    free(have);

    const uint64_t key = out[0]->key; /* a damaged file is computed anew */
    OK(run_session_close(&two, true));
    char path[300];
    path_in("bodies/store", key, path);
    assert_int_equal(truncate(path, 1000), 0);
    session three = opened(c, "bodies/three", "bodies/store");
    OK(run_scenes_all(&three, q, 1, out));
    assert_false(out[0]->entry.reused);
    have = body_scene_result(three.history, "a");
    assert_string_equal(have, want);
    free(have), free(want);
    OK(run_session_close(&three, true));
    OK(run_session_close(&one, true));
    case_inputs_free(coarse), case_inputs_free(again);
    for (int i = 0; i < 2; i++) case_inputs_free(other[i]);
    case_free(c);
}

/* A run that is overwritten keeps its store; scenes with snapshots, which are not in it, are computed again. */
static void test_force_keeps_it(void **state)
{
    (void)state;
    fresh_folder("force");
    breech_case *c = read_case(NULL);
    const scene_record *out[2];
    scene_query q[] = { query_at(c, 1400.0, "a"), query_at(c, 1600.0, "b") };
    q[0].impact.snapshots = 0;
    assert_true(q[1].impact.snapshots > 0);
    for (int k = 0; k < 3; k++) {
        session s = opened_with(c, "force", NULL, k == 1);
        OK(run_scenes_all(&s, q, 2, out));
        assert_int_equal(ran.scenes, k == 0 ? 2 : k == 1 ? 1 : 0);
        assert_int_equal(out[0]->entry.reused, k > 0);
        OK(run_session_close(&s, true));
    }
    case_free(c);
}

/* All files of a store are damaged: each is warned of once, however often it is looked for until its scene has come. */
static void test_damaged_is_said_once(void **state)
{
    (void)state;
    enum { N = 4 };
    breech_case *c = read_case(NULL);
    const scene_record *out[N];
    scene_query q[N];
    char path[300], name[N][8];
    fresh_folder("damaged");
    for (int k = 0; k < N; k++) {
        snprintf(name[k], sizeof name[k], "q%d", k);
        q[k] = query_at(c, 1400.0 + 100.0 * k, name[k]);
    }
    session s = opened(c, "damaged/one", "damaged/store");
    OK(run_scenes_all(&s, q, N, out));
    OK(run_session_close(&s, true));
    for (int k = 0; k < N; k++) {
        path_in("damaged/store", key_at(c, q[k].impact.scene.velocity, 3.0), path);
        assert_int_equal(truncate(path, 1000), 0);
    }
    s = opened(c, "damaged/two", "damaged/store");
    OK(run_scenes_all(&s, q, N, out));
    int said = 0;
    for (const char *at = s.warnings; (at = strstr(at, "is damaged")); at++) said++;
    assert_int_equal(said, N);
    OK(run_session_close(&s, true));
    case_free(c);
}

/* A damaged file, and one of another scene under this one's name: computed anew, and mended. */
static void test_damaged(void **state)
{
    (void)state;
    breech_case *c = read_case(NULL);
    const scene_record *out;
    const scene_query q[] = { query_at(c, 1400.0, "a"), query_at(c, 1600.0, "b") };
    char path[2][300];
    for (int k = 0; k < 2; k++) path_in("damaged/store", key_at(c, q[k].impact.scene.velocity, 3.0), path[k]);
    for (int kind = 0; kind < 3; kind++) {
        fresh_folder("damaged");
        session s = opened(c, "damaged/one", "damaged/store");
        for (int k = 0; k < 2; k++) OK(run_scenes_all(&s, &q[k], 1, &out));
        OK(run_session_close(&s, true));
        if (kind == 0) assert_int_equal(truncate(path[0], 1000), 0);
        if (kind == 1) assert_int_equal(truncate(path[0], 0), 0);
        if (kind == 2) assert_int_equal(rename(path[1], path[0]), 0);
        for (int again = 0; again < 2; again++) {
            s = opened(c, "damaged/two", "damaged/store");
            OK(run_scenes_all(&s, &q[0], 1, &out));
            assert_int_equal(ran.scenes, again == 0);
            assert_true(out->entry.result.severity == -100.0);
            OK(run_session_close(&s, true));
        }
    }
    case_free(c);
}

static void put_bytes(const char *path, const char *bytes, size_t n)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, n, f), n);
    assert_int_equal(fclose(f), 0);
}

/* One bit changed anywhere in a file of the store: it is never used, neither its result nor its series. */
static void test_flipped_bits(void **state)
{
    (void)state;
    enum { PLACES = 500, LAST = 40 };
    fresh_folder("flipped");
    breech_case *c = read_case(NULL);
    const scene_record *out;
    const scene_query q = query_at(c, 1400.0, "a");
    scene_key key;
    char path[300], *whole;
    size_t bytes;
    h5_file *f;
    OK(run_scene_key_of(&q.impact, &key));
    path_in("flipped/store", key.hash, path);
    session s = opened(c, "flipped/one", "flipped/store");
    OK(run_scenes_all(&s, &q, 1, &out));
    OK(run_session_close(&s, true));
    OK(host_file_read(path, &whole, &bytes));
    assert_true(bytes > 2 * PLACES);
    for (size_t i = 0; i < PLACES + LAST; i++) {
        const size_t at = i < PLACES ? i * bytes / PLACES : bytes - (PLACES + LAST - i);
        whole[at] ^= (char)(1 << i % 8);
        put_bytes(path, whole, bytes);
        const status got = run_store_get("flipped/store", &key, &f);
        if (got.code != STATUS_IO || f) fail_msg("bit %zu of byte %zu of %zu is not missed", i % 8, at, bytes);
        assert_non_null(strstr(got.text, path));
        if (i % 100 == 0) { /* a run: warned of, computed anew, the file mended */
            s = opened(c, "flipped/two", "flipped/store");
            OK(run_scenes_all(&s, &q, 1, &out));
            assert_int_equal(ran.scenes, 1);
            assert_false(out->entry.reused);
            assert_non_null(strstr(s.warnings, path));
            OK(run_session_close(&s, true));
            OK(run_store_get("flipped/store", &key, &f));
            host_h5_close(f);
        }
        whole[at] ^= (char)(1 << i % 8);
    }
    put_bytes(path, whole, bytes);
    s = opened(c, "flipped/three", "flipped/store");
    OK(run_scenes_all(&s, &q, 1, &out));
    assert_int_equal(ran.scenes, 0);
    OK(run_session_close(&s, true));
    free(whole);
    run_scene_key_free(&key);
    case_free(c);
}

/* ---- others at it ---- */

static void write_again_and_again(const char *dir, const scene_record *r, const scene_key *key)
{
    for (;;) {
        h5_file *f;
        if (run_scene_file_make(r, key, NULL, &f).code != STATUS_OK || run_store_put(dir, key, f).code != STATUS_OK)
            _exit(1);
        host_h5_close(f);
    }
}

/* Two programs write one scene all the time and are killed at any moment: whoever reads finds it whole. */
static void test_killed_writers(void **state)
{
    (void)state;
    fresh_folder("killed");
    OK(run_store_open("killed"));
    breech_case *c = read_case(NULL);
    const case_impact one = impact_at(c, 1500.0, 3.0);
    scene_record r = some_record(), back;
    scene_key key;
    OK(run_scene_key_of(&one, &key));
    int reads = 0;
    for (int round = 0; round < 12; round++) {
        pid_t child[2];
        for (int k = 0; k < 2; k++) {
            child[k] = fork();
            if (child[k] == 0) write_again_and_again("killed", &r, &key);
            assert_true(child[k] > 0);
        }
        for (int i = 0; i < 40 + round || (reads == 0 && i < 5000); i++) { /* the first file takes its time */
            h5_file *f;
            OK(run_store_get("killed", &key, &f));
            if (f) {
                OK(run_scene_file_read(f, &key, &back));
                reads++;
            }
            host_h5_close(f);
            usleep(1000);
        }
        for (int k = 0; k < 2; k++) {
            int end;
            kill(child[k], SIGKILL);
            assert_int_equal(waitpid(child[k], &end, 0), child[k]);
            assert_true(WIFSIGNALED(end)); /* it did not give up by itself */
        }
    }
    print_message("read %d times\n", reads);
    assert_true(reads > 100);
    run_scene_key_free(&key);
    case_free(c);
}

/* A full disk: the run fails with words, what was stored before is whole, and a later run takes it up. */
static void test_full_disk(void **state)
{
    (void)state;
    fresh_folder("full");
    breech_case *c = read_case(NULL);
    const scene_record *out;
    const scene_query q[] = { query_at(c, 1400.0, "a"), query_at(c, 1600.0, "b") };
    struct rlimit before, small;
    session s = opened(c, "full/one", "full/store");
    OK(run_scenes_all(&s, &q[0], 1, &out));
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = 4000; /* a file that would grow beyond fails like one on a full disk */
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const status full = run_scenes_all(&s, &q[1], 1, &out);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(full.code, STATUS_IO);
    assert_non_null(strstr(full.text, "cannot be written"));
    run_session_close(&s, false);
    s = opened(c, "full/two", "full/store");
    OK(run_scenes_all(&s, &q[0], 1, &out));
    assert_int_equal(ran.scenes, 0);
    OK(run_scenes_all(&s, &q[1], 1, &out));
    assert_int_equal(ran.scenes, 1);
    OK(run_session_close(&s, true));
    case_free(c);
}

/* What the store cannot take is in the run's checkpoint: going on computes it no second time. */
static void test_full_store(void **state)
{
    (void)state;
    fresh_folder("fullstore");
    breech_case *c = read_case(NULL);
    const scene_record *out;
    const scene_query q = query_at(c, 1400.0, "a");
    session s = opened(c, "fullstore/one", "fullstore/store");
    assert_int_equal(system("rm -rf fullstore/store && touch fullstore/store"), 0);
    assert_int_equal(run_scenes_all(&s, &q, 1, &out).code, STATUS_IO);
    assert_int_equal(ran.scenes, 1);
    assert_int_equal(access("fullstore/one/checkpoint.bin", F_OK), 0);
    OK(run_scenes_find(&s, &q, &out));
    assert_non_null(out);
    run_session_close(&s, false);
    case_free(c);
}

/* A checkpoint never runs ahead of the history: rows before it would be lost for good. */
static void test_history_first(void **state)
{
    (void)state;
    fresh_folder("first");
    breech_case *c = read_case(NULL);
    case_inputs *in = body_scene("scene.cell=0.5 mm");
    session s = opened(c, "first", "");
    mpm *m;
    int series;
    const double row[HISTORY_MAX_COLUMNS] = { 1e-6 };
    OK(mpm_create(&in->bodies.scene, 1, &m));
    const scene_now now = { m, NULL, 0.0 };
    OK(output_history_scene(s.history, "a", NULL, 0, &series));
    OK(output_history_append(s.history, series, row));
    assert_int_equal(symlink("/dev/full", "first/history.h5.part"), 0);
    assert_int_equal(run_session_save_inside(&s, "a", &now).code, STATUS_IO);
    assert_int_not_equal(access("first/checkpoint.bin", F_OK), 0);
    OK(run_session_save_inside(&s, "a", &now));
    assert_int_equal(access("first/checkpoint.bin", F_OK), 0);
    h5_file *f;
    OK(host_h5_open("first/history.h5", &f));
    assert_true(host_h5_exists(f, "/scene/a/time"));
    host_h5_close(f);
    mpm_free(m);
    OK(run_session_close(&s, false));
    case_inputs_free(in);
    case_free(c);
}

static void touch_named(const char *host, long pid, const char *end, char path[300])
{
    snprintf(path, 300, "left/0123456789abcdef.h5.%s-%ld%s", host, pid, end);
    put_bytes(path, "x", 1);
}

/* What killed processes of this machine have left half written goes; what others are writing stays. */
static void test_left_over(void **state)
{
    (void)state;
    fresh_folder("left");
    assert_int_equal(mkdir("left", 0777), 0);
    char host[64] = "", gone[2][300], kept[3][300];
    gethostname(host, sizeof host - 1);
    const pid_t child = fork();
    if (child == 0) _exit(0);
    assert_int_equal(waitpid(child, NULL, 0), child);
    touch_named(host, child, "", gone[0]);
    touch_named(host, child, ".part", gone[1]);
    touch_named(host, getpid(), ".part", kept[0]);
    touch_named("another-machine", child, "", kept[1]);
    snprintf(kept[2], sizeof kept[2], "left/mine.h5.%s-%ld", host, (long)child);
    put_bytes(kept[2], "x", 1);
    OK(run_store_open("left"));
    for (int i = 0; i < 2; i++) assert_int_not_equal(access(gone[i], F_OK), 0);
    for (int i = 0; i < 3; i++) assert_int_equal(access(kept[i], F_OK), 0);
}

/* A store that cannot be used is found before anything is computed or written. */
static void test_unusable(void **state)
{
    (void)state;
    fresh_folder("unusable");
    breech_case *c = read_case(NULL);
    const char *const stores[] = { "/proc/breech", "unusable_file" };
    put_bytes(stores[1], "x", 1);
    for (int i = 0; i < 2; i++) {
        session s;
        const session_options options = { .command = "onset",
                                          .dir = "unusable",
                                          .store = stores[i],
                                          .threads = 1,
                                          .progress_to = stderr,
                                          .quiet = true };
        const case_inputs in = case_inputs_of(c);
        const status opened_at_all = run_session_open(&in, &options, &s);
        assert_int_equal(opened_at_all.code, STATUS_IO);
        assert_non_null(strstr(opened_at_all.text, stores[i]));
        assert_int_not_equal(access("unusable", F_OK), 0);
        run_session_close(&s, false);
    }
    case_free(c);
}

/* A folder in the place of a scene's file is found before the scene is computed, also of one that is computed anew. */
static void test_folder_in_its_place(void **state)
{
    (void)state;
    fresh_folder("in_place");
    breech_case *c = read_case(NULL);
    const scene_record *out;
    scene_query q[] = { query_at(c, 1400.0, "a"), query_at(c, 1600.0, "b") };
    char path[300];
    path_in("in_place/store", key_at(c, 1600.0, 3.0), path);
    assert_int_equal(system("mkdir -p in_place/store"), 0);
    assert_int_equal(mkdir(path, 0777), 0);
    for (int anew = 0; anew < 2; anew++) {
        q[1].anew = anew == 1;
        session s = opened(c, anew ? "in_place/two" : "in_place/one", "in_place/store");
        OK(run_scenes_all(&s, &q[0], 1, &out));
        const int before = ran.scenes;
        const status refused = run_scenes_all(&s, &q[1], 1, &out);
        assert_int_equal(refused.code, STATUS_BAD_INPUT);
        assert_non_null(strstr(refused.text, path));
        assert_int_equal(ran.scenes, before);
        OK(run_session_close(&s, true));
    }
    case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_key_parts),     cmocka_unit_test(test_key_is_a_case),
        cmocka_unit_test(test_file),          cmocka_unit_test(test_shared),
        cmocka_unit_test(test_bodies),        cmocka_unit_test(test_force_keeps_it),
        cmocka_unit_test(test_damaged),       cmocka_unit_test(test_damaged_is_said_once),
        cmocka_unit_test(test_flipped_bits),  cmocka_unit_test(test_killed_writers),
        cmocka_unit_test(test_full_disk),     cmocka_unit_test(test_full_store),
        cmocka_unit_test(test_history_first), cmocka_unit_test(test_left_over),
        cmocka_unit_test(test_unusable),      cmocka_unit_test(test_folder_in_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
