/* SPDX-License-Identifier: BSD-3-Clause */
/* Snapshots: the structure that VTKHDF 1.0 asks for, the values that the particles have, the index, what a resumed run
 * keeps.  ParaView itself reads them when BREECH_FULL is 1. */
#include "output_common.h"

#include "coupling/host/outdir.h"
#include "coupling/output/snapshot.h"

/* Particle i, field f, component k: a value that says which it is, exact in float32. */
typedef struct {
    size_t n;
} fake_particles;

static void read_fake(const void *source, float *const out[MPM_FIELD_COUNT])
{
#define FIELD_WIDTH(name, width, unit, doc) width,
    static const size_t widths[] = { PARTICLE_FIELDS(FIELD_WIDTH) };
#undef FIELD_WIDTH
    const fake_particles *p = source;
    for (size_t field = 0; field < MPM_FIELD_COUNT; field++)
        for (size_t i = 0; i < p->n; i++)
            for (size_t k = 0; k < widths[field]; k++)
                out[field][i * widths[field] + k] = (float)(i * 128 + field * 8 + k);
}

static status write_one(snapshots *s, size_t n, double time)
{
    const fake_particles p = { n };
    return output_snapshots_write_source(s, &(snapshot_source){ time, n, read_fake, &p });
}

static void write_three(void)
{
    fresh_folder("snap");
    snapshots *s;
    OK(output_snapshots_open("snap", -1.0, &s));
    OK(write_one(s, 1000, 0.0));
    OK(write_one(s, 1500, 1e-6));
    OK(write_one(s, 3000, 2e-6));
    OK(output_snapshots_wait(s));
    assert_int_equal(output_snapshots_count(s), 3);
    output_snapshots_close(s);
}

static void structure_is_vtkhdf(void **state)
{
    (void)state;
    write_three();
    assert_int_equal(files_in("snap", ".part"), 0);
    assert_int_equal(files_in("snap", ".hdf"), 3);
    run_script("read_snapshot.py", "snap/scene-000001.hdf 1500 1e-6");
    run_script("read_snapshot.py", "snap/scene.hdf.series");
}

static void field_list_is_complete(void **state)
{
    (void)state;
    fresh_folder("snap");
    snapshots *s;
    OK(output_snapshots_open("snap", -1.0, &s));
    OK(write_one(s, 1, 0.0)); /* the smallest scene there is */
    output_snapshots_close(s);
    char names[1000] = "snap/scene-000000.hdf 1 0.0";
#define FIELD_NAME(name, width, unit, doc) " " #name
    strcat(names, PARTICLE_FIELDS(FIELD_NAME));
#undef FIELD_NAME
    run_script("read_snapshot.py", names);
}

/* A run that goes on when all points have left the window begins with one. */
static void snapshot_of_no_points(void **state)
{
    (void)state;
    fresh_folder("snap");
    snapshots *s;
    OK(output_snapshots_open("snap", -1.0, &s));
    OK(write_one(s, 0, 1e-6));
    OK(write_one(s, 3, 2e-6));
    OK(output_snapshots_wait(s));
    assert_int_equal(output_snapshots_count(s), 2);
    output_snapshots_close(s);
    run_script("read_snapshot.py", "snap/scene-000000.hdf 0 1e-6");
}

/* Stopped after 1.5 us: the first two stay and go on being counted, the third goes; parts of a killed writer go too. */
static void resumed_scene_goes_on(void **state)
{
    (void)state;
    write_three();
    FILE *part = fopen("snap/scene-000003.hdf.part", "w");
    fclose(part);
    snapshots *s;
    OK(output_snapshots_open("snap", 1.5e-6, &s));
    assert_int_equal(output_snapshots_count(s), 2);
    assert_int_equal(files_in("snap", ".hdf"), 2);
    assert_int_equal(files_in("snap", ".part"), 0);
    OK(write_one(s, 2000, 3e-6));
    assert_int_equal(output_snapshots_count(s), 3);
    output_snapshots_close(s);
    char *index;
    OK(host_file_read("snap/scene.hdf.series", &index, NULL));
    assert_non_null(strstr(index, "scene-000002.hdf"));
    assert_null(strstr(index, "scene-000003.hdf"));
    free(index);
    OK(output_snapshots_open("snap", -1.0, &s)); /* anew: all gone */
    assert_int_equal(files_in("snap", ".hdf"), 0);
    output_snapshots_close(s);
}

static void assert_listed(const char *name, bool listed)
{
    char *index;
    OK(host_file_read("snap/scene.hdf.series", &index, NULL));
    assert_int_equal(strstr(index, name) != NULL, listed);
    free(index);
}

/* The next call says it, be that the wait or the next snapshot, which is then not written either. */
static void full_disk_leaves_no_half_snapshot(void **state)
{
    (void)state;
    for (int next = 0; next < 2; next++) {
        fresh_folder("snap");
        snapshots *s;
        OK(output_snapshots_open("snap", -1.0, &s));
        assert_int_equal(symlink("/dev/full", "snap/scene-000000.hdf.part"), 0);
        OK(write_one(s, 1000, 0.0));
        const status full = next ? write_one(s, 1000, 1e-6) : output_snapshots_wait(s);
        assert_int_equal(full.code, STATUS_IO);
        assert_non_null(strstr(full.text, "scene-000000.hdf"));
        assert_int_equal(files_in("snap", ".hdf"), 0);
        assert_listed("scene-000000.hdf", false);
        assert_int_equal(output_snapshots_count(s), 0);
        OK(output_snapshots_wait(s)); /* said once */
        OK(write_one(s, 1000, 0.0));  /* room again */
        OK(output_snapshots_wait(s));
        assert_int_equal(output_snapshots_count(s), 1);
        assert_listed("scene-000000.hdf", true);
        output_snapshots_close(s);
    }
    snapshots *s;
    assert_int_equal(output_snapshots_open("snap/nowhere", -1.0, &s).code, STATUS_IO);
    assert_null(s);
}

typedef struct {
    bool refuses;
    char index[500]; /* the last that came */
} fake_sink;

static status put_away(void *user, const char *path, const void *data, size_t bytes)
{
    fake_sink *to = user;
    CHECK(!to->refuses, STATUS_IO, "%s: not taken", path);
    if (strstr(path, "series")) snprintf(to->index, sizeof to->index, "%.*s", (int)bytes, (const char *)data);
    return status_ok();
}

/* Where files are handed to somebody else too, one that was not taken is none. */
static void refused_snapshot_is_not_listed(void **state)
{
    (void)state;
    fresh_folder("snap");
    fake_sink to = { .refuses = false };
    snapshots *s;
    OK(output_snapshots_open_sink("snap", &(snapshot_sink){ put_away, &to }, &s));
    to.refuses = true;
    assert_int_equal(write_one(s, 10, 0.0).code, STATUS_IO);
    assert_int_equal(output_snapshots_count(s), 0);
    to.refuses = false;
    OK(write_one(s, 10, 1e-6));
    assert_non_null(strstr(to.index, "scene-000000.hdf"));
    assert_null(strstr(to.index, "scene-000001.hdf"));
    output_snapshots_close(s);
}

/* After the wait it is there, with the index that lists it, and stays so when more come. */
static void waiting_puts_it_on_disk(void **state)
{
    (void)state;
    fresh_folder("snap");
    snapshots *s;
    OK(output_snapshots_open("snap", -1.0, &s));
    for (int i = 0; i < 20; i++) {
        char name[40];
        OK(write_one(s, 5000, 1e-6 * i));
        OK(output_snapshots_wait(s));
        assert_int_equal(files_in("snap", ".hdf"), i + 1);
        snprintf(name, sizeof name, "scene-%06d.hdf", i);
        assert_listed(name, true);
    }
    output_snapshots_close(s);
    OK(output_snapshots_wait(NULL));
}

static void paraview_reads_it(void **state)
{
    (void)state;
    if (!full_tests()) skip();
    if (system("command -v pvbatch xvfb-run > /dev/null") != 0) {
        print_message("paraview or xvfb is not installed\n");
        skip();
    }
    write_three();
    assert_int_equal(system("xvfb-run -a -n $((100 + $$ % 9000)) pvbatch '" BREECH_TESTS
                            "/paraview/check.py' snap/scene.hdf.series snap/picture.png"),
                     0);
    assert_true(host_file_exists("snap/picture.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(structure_is_vtkhdf),
        cmocka_unit_test(field_list_is_complete),
        cmocka_unit_test(resumed_scene_goes_on),
        cmocka_unit_test(full_disk_leaves_no_half_snapshot),
        cmocka_unit_test(waiting_puts_it_on_disk),
        cmocka_unit_test(snapshot_of_no_points),
        cmocka_unit_test(refused_snapshot_is_not_listed),
        cmocka_unit_test(paraview_reads_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
