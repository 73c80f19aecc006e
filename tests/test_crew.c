/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes over several processes: the same as by one, whoever computes them, on whatever threads are lent.
 *
 * Started by ctest as one process, it starts itself again as one that forks two more, and then under mpirun; rank 0
 * tests, the others serve. */
#define _GNU_SOURCE /* sched_setaffinity */

#include "coupling/case/case.h"
#include "coupling/gouge/impact.h"
#include "coupling/run/crew.h"
#include "coupling/run/lending.h"
#include "coupling/run/ranks.h"

#include <dirent.h>
#include <math.h>
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "status_common.h"

#include "body_scenes.h"

#define CASES BREECH_TESTS "/../cases"
enum { PROCESSES = 3, SKIPPED = 77, SUBSETS = 1 << PROCESSES };

/* What main, which all processes run, has seen before the tests; and what they lend by. */
static lending *lent;
static int shares[SUBSETS][PROCESSES];
static bool all_cores;

/* Some steps of real solver, a stub of an armature for a millionth of a second; `long_stub`: its groove has room. */
static breech_case *stub_case(const char *end_time, bool long_stub)
{
    const char *const dirs[] = { CASES "/materials" };
    const case_options how = { dirs, 1, CASE_FOR_ONSET };
    const char *const sets[] = { end_time,
                                 "scene.coarse_cell=1.2 mm",
                                 "scene.levels=2",
                                 "scene.growth=1.3",
                                 long_stub ? "scene.rail_ahead=6 mm" : "scene.rail_ahead=4 mm",
                                 "scene.rail_behind=1 mm",
                                 long_stub ? "scene.rail_depth=5 mm" : "scene.rail_depth=3 mm",
                                 long_stub ? "armature.length=8 mm" : "armature.length=6 mm",
                                 "armature.half_bore=5 mm",
                                 long_stub ? "armature.width=8 mm" : "armature.width=6 mm",
                                 "armature.head_thickness=5 mm",
                                 "armature.leg_thickness=3 mm",
                                 "output.snapshots=2" };
    breech_case *c = NULL;
    char *errors = NULL;
    const status s = case_read(CASES "/default_shot", sets, sizeof sets / sizeof *sets, &how, &c, &errors);
    if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
    return c;
}

static breech_case *small_case(const char *end_time)
{
    return stub_case(end_time, false);
}

static scene_query query_at(const breech_case *c, double velocity)
{
    const case_impact from = case_inputs_of(c).onset.impact;
    const site_state state = { .grain = c->sites.item[0],
                               .reached = true,
                               .velocity = velocity,
                               .contact_pressure = 75e6,
                               .lead_face_temperature = NAN };
    scene_query q = { .impact = gouge_impact_at(&from, &state, 1.2) };
    snprintf(q.name, sizeof q.name, "v%g-%p", velocity, (const void *)c);
    return q;
}

static void begin_session(const breech_case *c, const char *dir, bool resumed, session *s)
{
    const session_options options = { .command = "onset",
                                      .dir = dir,
                                      .store = "",
                                      .how = { .force = !resumed, .resume = resumed },
                                      .threads = 1,
                                      .lending = lent,
                                      .run_scene = gouge_run,
                                      .progress_to = stderr,
                                      .quiet = true };
    const case_inputs in = case_inputs_of(c);
    OK(run_session_open(&in, &options, s));
    assert_non_null(s->crew);
}

static void open_session(const breech_case *c, const char *dir, session *s)
{
    begin_session(c, dir, false, s);
}

static void resume_session(const breech_case *c, const char *dir, session *s)
{
    begin_session(c, dir, true, s);
}

/* What one process gives. */
static scene_record alone(const breech_case *c, const scene_query *q)
{
    session s;
    open_session(c, "alone", &s);
    crew *others = s.crew;
    const scene_record *out;
    s.crew = NULL;
    OK(run_scenes_all(&s, q, 1, &out));
    const scene_record copy = *out;
    s.crew = others;
    OK(run_session_close(&s, true));
    return copy;
}

static void assert_same(scene_record a, scene_record b)
{
    a.entry.result.wall_seconds = b.entry.result.wall_seconds = 0.0;
    assert_true(a.entry.result.steps > 20 && isfinite(a.entry.result.severity));
    /* what goes with the armature is the armature, 147 mm3 of it at the start, 244 of a long one */
    const double *carried = a.entry.result.carried_volume;
    assert_true(carried[a.entry.result.bodies - 1] > 130e-9 && carried[a.entry.result.bodies - 1] < 245e-9);
    assert_true(carried[0] < 1e-9);
    /* one NaN need not have the other's bits */
    if (isnan(a.entry.result.widening) && isnan(b.entry.result.widening))
        a.entry.result.widening = b.entry.result.widening = 0.0;
    assert_memory_equal(&a.entry, &b.entry, sizeof a.entry);
    assert_true(a.impulse == b.impulse && a.mass_loss == b.mass_loss && a.key == b.key);
}

static bool is_there(const char *dir, const char *scene, const char *file)
{
    char path[400];
    snprintf(path, sizeof path, "%s/scenes/%s/%s", dir, scene, file);
    return access(path, F_OK) == 0;
}

/* A batch: the same bits, the history and the snapshots of every scene. */
static void test_batch(void **state)
{
    (void)state;
    enum { N = 5 };
    breech_case *c = small_case("scene.end_time=1 us");
    scene_query q[N];
    const scene_record *out[N];
    for (int i = 0; i < N; i++) q[i] = query_at(c, 1300.0 + 100.0 * i);
    session s;
    open_session(c, "batch", &s);
    OK(run_scenes_all(&s, q, N, out));
    assert_int_equal(s.n_records, N);
    for (int i = 0; i < N; i++) {
        assert_same(*out[i], alone(c, &q[i]));
        assert_true(output_history_has(s.history, q[i].name));
        assert_true(is_there("batch", q[i].name, "scene-000000.hdf") &&
                    is_there("batch", q[i].name, "scene-000001.hdf"));
        assert_true(is_there("batch", q[i].name, "scene.hdf.series"));
    }
    OK(run_session_close(&s, true));
    case_free(c);
}

/* After every step of rank 0: the others are sooner, whatever else the machine does. */
static bool dawdle(void)
{
    nanosleep(&(struct timespec){ 0, 20000000 }, NULL);
    return false;
}

/* Rank 0's own scene is the long one: it is laid aside when a wanted one has come, and goes on to the same bits. */
static void test_laid_aside(void **state)
{
    (void)state;
    breech_case *c = small_case("scene.end_time=1 us"), *longer = small_case("scene.end_time=10 us");
    const scene_query q[] = { query_at(longer, 1500.0), query_at(c, 1400.0), query_at(c, 1600.0) };
    const scene_record *out[3];
    int rounds = 0, known = 0;
    session s;
    open_session(c, "aside", &s);
    s.stop = dawdle;
    while (known < 3) {
        const int before = known;
        OK(run_scenes_some(&s, q, 3));
        known = 0;
        for (int i = 0; i < 3; i++) {
            OK(run_scenes_find(&s, &q[i], &out[i]));
            known += out[i] != NULL;
        }
        assert_true(known > before);
        if (++rounds == 1) assert_null(out[0]);
    }
    assert_true(rounds >= 2);
    for (int i = 0; i < 3; i++) assert_same(*out[i], alone(c, &q[i]));
    OK(run_session_close(&s, true));
    case_free(c);
    case_free(longer);
}

/* What was computed ahead is there at once when it is asked for, and leaves no trace when it is not. */
static void test_ahead(void **state)
{
    (void)state;
    breech_case *c = small_case("scene.end_time=1 us"), *longer = small_case("scene.end_time=10 us");
    const scene_query wanted = query_at(longer, 1500.0), ahead[] = { query_at(c, 1400.0), query_at(c, 1600.0) };
    const scene_record *out, *none;
    session s;
    open_session(c, "ahead", &s);
    OK(run_scenes_ahead(&s, ahead, 2, false));
    OK(run_scenes_all(&s, &wanted, 1, &out));
    assert_int_equal(s.n_records, 1);
    OK(run_scenes_find(&s, &ahead[0], &out)); /* the others have long finished it */
    assert_non_null(out);
    assert_false(out->entry.reused);
    assert_same(*out, alone(c, &ahead[0]));
    OK(run_scenes_ahead(&s, NULL, 0, false));
    OK(run_scenes_find(&s, &wanted, &none));
    OK(run_session_close(&s, true));
    assert_true(is_there("ahead", ahead[0].name, "scene.hdf.series"));
    assert_false(is_there("ahead", ahead[1].name, "scene.hdf.series"));
    case_free(c);
    case_free(longer);
}

/* When its last snapshot was written [s]; infinite: it is not there yet. */
static double written_at(const char *dir, const char *scene)
{
    char path[400];
    struct stat about;
    snprintf(path, sizeof path, "%s/scenes/%s/scene-000001.hdf", dir, scene);
    if (stat(path, &about) != 0) return INFINITY;
    return (double)about.st_mtim.tv_sec + 1e-9 * (double)about.st_mtim.tv_nsec;
}

/* Of two scenes that are wanted while members compute what may be, rank 0 takes the long one and a member the other at
 * once: it is done before that and before what they compute. */
static void assert_at_once(session *s, const breech_case *c, const scene_query ahead[2], const scene_query *first,
                           const scene_query two[2])
{
    const scene_record *out[2];
    OK(run_scenes_ahead(s, ahead, 2, false));
    OK(run_scenes_all(s, first, 1, out)); /* by rank 0, while the others have begun what may come */
    s->stop = dawdle;
    OK(run_scenes_all(s, two, 2, out));
    s->stop = NULL;
    const double done = written_at("put-off", two[1].name);
    assert_true(done < written_at("put-off", two[0].name));
    for (int i = 0; i < 2; i++) assert_true(done < written_at("put-off", ahead[i].name));
    for (int i = 0; i < 2; i++) assert_same(*out[i], alone(c, &two[i]));
}

/* Members that compute what may be wanted put it off for what is, and go on with it afterwards; what nobody asks for
 * any more they give up.  All of it to the same bits. */
static void test_put_off(void **state)
{
    (void)state;
    breech_case *c = small_case("scene.end_time=1 us"), *longer = small_case("scene.end_time=3 us"),
                *longest = small_case("scene.end_time=6 us");
    scene_query slow[] = { query_at(longest, 1420.0), query_at(longest, 1620.0) };
    for (int i = 0; i < 2; i++) slow[i].impact.scene.cells_per_radius = 2.0;
    const scene_query ahead[] = { query_at(longest, 1400.0), query_at(longest, 1600.0) };
    const scene_query left[] = { query_at(longer, 1400.0), query_at(longer, 1600.0) };
    const scene_query two[] = { query_at(longer, 1550.0), query_at(c, 1450.0) };
    const scene_query later[] = { query_at(c, 1460.0), query_at(c, 1470.0) };
    const scene_query first = query_at(c, 1500.0), second = query_at(c, 1510.0), last = query_at(c, 1350.0);
    const scene_record *out[2];
    session s;
    open_session(c, "put-off", &s);
    assert_at_once(&s, c, slow, &first, two);
    OK(run_scenes_ahead(&s, ahead, 2, false));
    OK(run_scenes_all(&s, &second, 1, out));
    OK(run_scenes_all(&s, later, 2, out));
    OK(run_scenes_all(&s, ahead, 2, out)); /* wanted after all: from where they were put off */
    for (int i = 0; i < 2; i++) assert_same(*out[i], alone(c, &ahead[i]));
    OK(run_scenes_ahead(&s, left, 2, false));
    OK(run_scenes_all(&s, &first, 1, out)); /* known */
    OK(run_scenes_ahead(&s, NULL, 0, false));
    OK(run_scenes_all(&s, &last, 1, out)); /* nobody wants the others: given up where they are */
    OK(run_scenes_all(&s, left, 2, out));  /* or does: from the start */
    for (int i = 0; i < 2; i++) assert_same(*out[i], alone(c, &left[i]));
    OK(run_session_close(&s, true));
    case_free(c);
    case_free(longer);
    case_free(longest);
}

/* A scene that cannot be: the words of the process that met it. */
static void test_failed(void **state)
{
    (void)state;
    breech_case *c = small_case("scene.end_time=1 us");
    const scene_query q[] = { query_at(c, 1500.0), query_at(c, -1.0), query_at(c, 1400.0) };
    const scene_record *out[3];
    session s;
    open_session(c, "failed", &s);
    const status done = run_scenes_all(&s, q, 3, out);
    assert_int_equal(done.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(done.text, "velocity"));
    OK(run_scenes_all(&s, &q[2], 1, out)); /* the crew is none the worse */
    OK(run_session_close(&s, false));
    case_free(c);
}

static bool stop_at_once(void)
{
    return true;
}

static void test_stopped(void **state)
{
    (void)state;
    breech_case *c = small_case("scene.end_time=5 us");
    const scene_query q[] = { query_at(c, 1500.0), query_at(c, 1400.0) };
    const scene_record *out[2];
    session s;
    open_session(c, "stopped", &s);
    s.stop = stop_at_once;
    assert_int_equal(run_scenes_all(&s, q, 2, out).code, STATUS_STOPPED);
    OK(run_session_close(&s, false));
    case_free(c);
}

static char shown[300]; /* the snapshot after which rank 0 stops */

static bool stop_once_shown(void)
{
    return access(shown, F_OK) == 0;
}

/* Stopped inside rank 0's own scene: its snapshots stay with the checkpoint, and the resumed run has all of them. */
static void test_snapshots_resumed(void **state)
{
    (void)state;
    enum { SNAPSHOTS = 6 };
    breech_case *c = small_case("scene.end_time=4 us");
    c->output.snapshots = SNAPSHOTS;
    const scene_query q = query_at(c, 1500.0);
    const scene_record *out;
    session s;
    snprintf(shown, sizeof shown, "kept/scenes/%s/scene-000002.hdf", q.name);
    open_session(c, "kept", &s);
    s.stop = stop_once_shown;
    assert_int_equal(run_scenes_all(&s, &q, 1, &out).code, STATUS_STOPPED);
    OK(run_session_close(&s, false));
    assert_true(is_there("kept", q.name, "scene-000000.hdf"));
    resume_session(c, "kept", &s);
    assert_true(run_session_resume_of(&s, q.name).image != NULL);
    OK(run_scenes_all(&s, &q, 1, &out));
    assert_same(*out, alone(c, &q));
    for (int i = 0; i <= SNAPSHOTS; i++) {
        char file[40];
        snprintf(file, sizeof file, "scene-%06d.hdf", i);
        assert_true(is_there("kept", q.name, file) == is_there("alone", q.name, file));
        assert_true(is_there("kept", q.name, file) || i == SNAPSHOTS);
    }
    OK(run_session_close(&s, true));
    case_free(c);
}

/* ---- lending ---- */

/* Every process with threads of its own, first one, then two, three; whoever is at work, none are lost. */
static void test_shares(void **state)
{
    (void)state;
    for (int at_work = 1; at_work < SUBSETS; at_work++) {
        int sum = 0;
        for (int i = 0; i < PROCESSES; i++) {
            if (!(at_work >> i & 1)) continue;
            assert_true(shares[at_work][i] >= i + 1);
            sum += shares[at_work][i];
        }
        assert_int_equal(sum, 1 + 2 + 3);
    }
    assert_int_equal(shares[1 | 2][0], 1 + 2); /* of three the larger half */
    assert_true(all_cores);
}

static int tasks(void)
{
    int n = 0;
    DIR *d = opendir("/proc/self/task");
    assert_non_null(d);
    for (const struct dirent *e = readdir(d); e; e = readdir(d)) n += e->d_name[0] != '.';
    closedir(d);
    return n;
}

/* Scenes of bodies in a batch: whoever computes them, result, series and snapshots are those of one process. */
static void test_bodies(void **state)
{
    (void)state;
    enum { N = 4 };
    static const char *const cells[N] = { "scene.cell=0.4 mm", "scene.cell=0.35 mm", "scene.cell=0.3 mm",
                                          "scene.cell=0.25 mm" };
    breech_case *c = small_case("scene.end_time=1 us");
    case_inputs *in[N];
    scene_query q[N];
    const scene_record *out[N], *own;
    session s, single;
    for (int i = 0; i < N; i++) {
        char name[20];
        snprintf(name, sizeof name, "cell%d", i);
        in[i] = body_scene(cells[i]);
        q[i] = body_scene_query(in[i], name);
    }
    open_session(c, "bodies", &s);
    OK(run_scenes_all(&s, q, N, out));
    assert_int_equal(s.n_records, N);
    char *have[N];
    for (int i = 0; i < N; i++) have[i] = body_scene_result(s.history, q[i].name);
    for (int i = 0; i < N; i++)
        assert_true(is_there("bodies", q[i].name, "scene-000000.hdf") &&
                    is_there("bodies", q[i].name, "scene.hdf.series"));
    open_session(c, "bodies_alone", &single);
    crew *others = single.crew;
    single.crew = NULL;
    for (int i = 0; i < N; i++) {
        OK(run_scenes_all(&single, &q[i], 1, &own));
        assert_true(own->key == out[i]->key);
        char *want = body_scene_result(single.history, q[i].name);
        assert_string_equal(have[i], want);
        assert_same_body_series(s.history, q[i].name, single.history, q[i].name);
        free(want), free(have[i]);
    }
    single.crew = others;
    OK(run_session_close(&single, true));
    OK(run_session_close(&s, true));
    for (int i = 0; i < N; i++) case_inputs_free(in[i]);
    case_free(c);
}

/* One scene while the others idle: on everybody's threads, to the bits of one. */
static void test_lent(void **state)
{
    (void)state;
    breech_case *c = small_case("scene.end_time=1 us");
    const scene_query q = query_at(c, 1500.0);
    const scene_record *out;
    const scene_record want = alone(c, &q);
    const int before = tasks();
    session s;
    open_session(c, "lent", &s);
    OK(run_scenes_all(&s, &q, 1, &out));
    assert_same(*out, want);

    assert_true(tasks() >= before + PROCESSES - 1);
    OK(run_session_close(&s, true));
    case_free(c);
}

static bool comes_to(const scene_host *host, int threads)
{
    const double limit = host_wall_clock() + 60.0;
    while (host->threads_now(host->user) != threads && host_wall_clock() < limit) {
        host->stop(host->user); /* hears the others */
        run_ranks_pause();
    }
    return host_wall_clock() < limit;
}

static int borrowed; /* the runs in which this was seen */

/* The first waits until both others compute, and until both have done. */
static status run_and_look(const impact_job *job, const scene_host *host, impact *out)
{
    if (!borrowed++) {
        assert_true(comes_to(host, 1));
        assert_true(comes_to(host, PROCESSES));
    }
    return gouge_run(job, host, out);
}

/* Who computes lends nothing, and lends again when it has done. */
static void test_given_back(void **state)
{
    (void)state;
    breech_case *c = small_case("scene.end_time=1 us");
    const scene_query q[] = { query_at(c, 1500.0), query_at(c, 1400.0), query_at(c, 1600.0) };
    const scene_record *out[3];
    session s;
    open_session(c, "given-back", &s);
    s.run_scene = run_and_look;
    OK(run_scenes_all(&s, q, 3, out));
    assert_true(borrowed > 0);
    for (int i = 0; i < 3; i++) assert_same(*out[i], alone(c, &q[i]));
    OK(run_session_close(&s, true));
    case_free(c);
}

/* ---- starting ---- */

/* As a launcher does it: to one core. */
static void bind_to_one(const cpu_set_t *cores)
{
    cpu_set_t one;
    int core = 0, left = run_ranks_number() % CPU_COUNT(cores);
    while (!CPU_ISSET(core, cores) || left-- > 0) core++;
    CPU_ZERO(&one);
    CPU_SET(core, &one);
    sched_setaffinity(0, sizeof one, &one);
}

static bool has_all(const cpu_set_t *cores)
{
    cpu_set_t mine;
    return sched_getaffinity(0, sizeof mine, &mine) == 0 && (CPU_EQUAL(&mine, cores) || CPU_COUNT(&mine) == PROCESSES);
}

/* All processes together, for every subset of them at work. */
static status try_shares(void)
{
    const int me = run_ranks_number();
    lending *l;
    TRY(run_lending_open(1, &l));
    run_lending_own(l, me + 1);
    for (int at_work = 0; at_work < SUBSETS; at_work++) {
        ranks_memory all;
        if (at_work >> me & 1) run_lending_begin(l);
        TRY(run_ranks_share(&me, sizeof me, &all)); /* all have begun */
        run_ranks_unshare(&all);
        const int mine = run_lending_threads(l);
        TRY(run_ranks_share(&mine, sizeof mine, &all));
        memcpy(shares[at_work], all.part, sizeof shares[at_work]);
        run_ranks_unshare(&all);
        if (at_work >> me & 1) run_lending_end(l);
    }
    run_lending_close(l);
    return status_ok();
}

static status start_lending(void)
{
    cpu_set_t cores;
    sched_getaffinity(0, sizeof cores, &cores);
    bind_to_one(&cores);
    TRY(run_lending_open(1, &lent));
    all_cores = has_all(&cores);
    return try_shares();
}

/* ---- the shelf ---- */

static breech_case *grown_case(bool to_gauge)
{
    breech_case *c = stub_case("scene.end_time=2.85 us", true);
    c->scene.courant = 0.3; /* more steps than pieces: none ends with the gauge's */
    c->scene.levels = 2;
    c->scene.stop_when_gauged = to_gauge;
    c->output.snapshots = 0;
    return c;
}

static scene_query grown_query(const breech_case *c, double velocity)
{
    scene_query q = query_at(c, velocity);
    q.impact.particle.radius = q.impact.particle.height = 0.2e-3;
    q.impact.scene.contact_pressure = 300e6;
    return q;
}

static int own_runs; /* begun: one that was laid aside goes on */

static status count_run(const impact_job *job, const scene_host *host, impact *out)
{
    own_runs += !job->resume.image;
    return gouge_run(job, host, out);
}

/* A whole scene is computed by the one that has computed it to its gauge. */
static void test_keeper(void **state)
{
    (void)state;
    breech_case *c = grown_case(true), *whole = grown_case(false);
    const scene_query to_gauge[] = { grown_query(c, 2500.0), grown_query(c, 2490.0) };
    const scene_query q[] = { grown_query(whole, 2500.0), grown_query(whole, 2490.0) };
    const scene_record *out[2];
    session s;
    open_session(c, "keeper", &s);
    s.run_scene = count_run;
    OK(run_scenes_all(&s, to_gauge, 2, out)); /* the first by rank 0 */
    /* grooves that surely grow, by half an e-fold from gauge to gauge: only such a scene is kept to go on from */
    for (int i = 0; i < 2; i++) assert_int_equal(out[i]->entry.result.class, DAMAGE_GOUGE);
    assert_int_equal(own_runs, 1);
    OK(run_scenes_all(&s, &q[1], 1, &out[1]));
    assert_int_equal(own_runs, 1);
    OK(run_scenes_all(&s, &q[0], 1, &out[0]));
    assert_int_equal(own_runs, 2);
    assert_same(*out[1], alone(whole, &q[1]));
    OK(run_session_close(&s, true));
    case_free(c);
    case_free(whole);
}

/* Two send each other more than any buffer holds, at the same time: neither waits for ever. */
static status try_crossing(void)
{
    enum { BYTES = 8 << 20, KIND = 7 };
    const int me = run_ranks_number();
    if (me > 1) return status_ok();
    char *data = malloc(BYTES);
    CHECK(data, STATUS_MEMORY, "no memory");
    memset(data, 'a' + me, BYTES);
    TRY(run_ranks_send(1 - me, KIND, data, BYTES));
    message m;
    bool any = false;
    while (!any) TRY(run_ranks_receive(&m, &any));
    memset(data, 'a' + 1 - me, BYTES);
    const bool same = m.from == 1 - me && m.kind == KIND && m.bytes == BYTES && memcmp(m.data, data, BYTES) == 0;
    run_message_free(&m);
    free(data);
    CHECK(same, STATUS_IO, "what rank %d got is not what was sent", me);
    return status_ok();
}

/* A snapshot's bytes to a rank 0 that looks seldom, as it does who steps a scene: once begun they come as a whole. */
static status try_large(void)
{
    enum { BYTES = 16 << 20, BEGINS = 8, MOST = 5 };
    const int me = run_ranks_number();
    if (me > 1) return status_ok();
    message m;
    bool any = false;
    int looks = 0;
    if (me == 1) {
        char *data = calloc(1, BYTES);
        CHECK(data, STATUS_MEMORY, "no memory");
        TRY(run_ranks_send(0, BEGINS, "", 0));
        TRY(run_ranks_send(0, BEGINS + 1, data, BYTES));
        free(data);
        return status_ok();
    }
    for (int part = 0; part < 2; part++, any = false)
        while (!any) {
            if (part == 1 && looks++ > 0) nanosleep(&(struct timespec){ 0, 50000000 }, NULL);
            TRY(run_ranks_receive(&m, &any));
            run_message_free(&m);
        }
    CHECK(looks <= MOST, STATUS_IO, "%d bytes took %d looks", (int)BYTES, looks);
    return status_ok();
}

/* One of them is killed while rank 0 waits for it. */
static int with_a_death(void)
{
    if (run_ranks_start(PROCESSES).code != STATUS_OK) return 1;
    if (run_ranks_number() == 1) raise(SIGKILL);
    for (message m;;) {
        bool any;
        if (run_ranks_receive(&m, &any).code != STATUS_OK) return 2;
        run_ranks_pause();
    }
}

/* Rank 0 does not run while the other comes to the last meeting, goes on and ends: nobody is missing. */
static int with_an_early_end(void)
{
    ranks_memory all;
    if (run_ranks_start(2).code != STATUS_OK) return 1;
    const int me = run_ranks_number();
    if (run_ranks_share(&me, sizeof me, &all).code != STATUS_OK) return 1;
    const pid_t leader = getppid(), self = getpid();
    if (me == 1) {
        nanosleep(&(struct timespec){ 0, 50000000 }, NULL); /* by now rank 0 waits for this one */
        const pid_t waker = fork();
        if (waker < 0) return 1;
        if (waker == 0) {
            while (getppid() == self) run_ranks_pause();
            kill(leader, SIGCONT);
            _exit(0);
        }
        kill(leader, SIGSTOP);
    }
    run_ranks_unshare(&all);
    run_ranks_finish();
    return 0;
}

/* Its exit code, and the first line of what it says at the end of standard error. */
static int started_again(const char *self, const char *how, char *said, size_t size)
{
    char command[4000];
    snprintf(command, sizeof command, "env -u OMP_PROC_BIND -u OMP_PLACES '%s' %s 2>%s", self, how,
             said ? "&1 >/dev/null" : "&2");
    FILE *f = popen(command, "r");
    if (!f) return -1;
    char line[1000];
    while (fgets(line, sizeof line, f))
        if (said)
            snprintf(said, size, "%s", line);
        else
            fputs(line, stdout);
    const int result = pclose(f);
    return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

static int forked(const char *self)
{
    char said[1000] = "";
    const int code = started_again(self, "dying", said, sizeof said);
    printf("one of %d killed: exit code %d, %s", PROCESSES, code, said);
    if (code != 1 || !strstr(said, "process 1 of 3 ended by signal 9") || !strstr(said, "--resume")) return 1;
    if (started_again(self, "early", said, sizeof said) != 0)
        return printf("one ended before rank 0 looked: %s", said), 1;
    return started_again(self, "forked", NULL, 0);
}

static int as_crew(const char *self)
{
    char count[8];
    snprintf(count, sizeof count, "%d", PROCESSES);
    unsetenv("OMP_PROC_BIND"); /* nothing would be lent */
    unsetenv("OMP_PLACES");
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    fflush(NULL);
    setenv("LSAN_OPTIONS", "detect_leaks=0", 1); /* MPI's own, whose libraries are gone by then: no name to suppress */
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    execlp("mpirun", "mpirun", "--bind-to", "none", "-n", count, self, "crew", (char *)NULL);
    puts("skipped: there is no mpirun");
    return SKIPPED;
}

int main(int argc, char **argv)
{
    if (argc == 1) return forked(argv[0]) ? 1 : as_crew(argv[0]);
    if (strcmp(argv[1], "dying") == 0) return with_a_death();
    if (strcmp(argv[1], "early") == 0) return with_an_early_end();
    const bool by_launcher = strcmp(argv[1], "crew") == 0;
    const struct CMUnitTest messages[] = { cmocka_unit_test(test_shares), cmocka_unit_test(test_put_off) };
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lent), /* first: no other has made threads yet */
        cmocka_unit_test(test_shares),  cmocka_unit_test(test_given_back),
        cmocka_unit_test(test_keeper),  cmocka_unit_test(test_batch),
        cmocka_unit_test(test_bodies),  cmocka_unit_test(test_laid_aside),
        cmocka_unit_test(test_ahead),   cmocka_unit_test(test_failed),
        cmocka_unit_test(test_stopped), cmocka_unit_test(test_snapshots_resumed),
        cmocka_unit_test(test_put_off),
    };
    int failed = 0;
    if (run_ranks_start(by_launcher ? 1 : PROCESSES).code != STATUS_OK) return SKIPPED; /* built without MPI */
    if (run_ranks_count() < PROCESSES) return puts("skipped: not started by mpirun"), SKIPPED;
    alarm(600); /* rather than wait for ever */
    if (start_lending().code != STATUS_OK || try_crossing().code != STATUS_OK || try_large().code != STATUS_OK)
        return 1;
    if (run_ranks_number() == 0) {
        failed = by_launcher ? cmocka_run_group_tests(messages, NULL, NULL) : cmocka_run_group_tests(tests, NULL, NULL);
        run_crew_dismiss();
    } else {
        run_crew_serve(1, lent, gouge_run);
    }
    run_lending_close(lent);
    run_ranks_finish();
    return failed;
}
