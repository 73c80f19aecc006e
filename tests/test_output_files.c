/* SPDX-License-Identifier: BSD-3-Clause */
/* Output directory, files that appear at once, checkpoints, progress, stop requests. */
#include "output_common.h"

#include "coupling/host/background.h"
#include "coupling/host/machine.h"
#include "coupling/host/outdir.h"
#include "coupling/host/progress.h"
#include "coupling/host/stop.h"
#include "coupling/host/table.h"
#include "coupling/run/checkpoint.h"
#include "coupling/run/scene_key.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

static void put(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

/* ---- files ---- */

static void file_comes_back(void **state)
{
    (void)state;
    fresh_folder("files");
    char *text;
    size_t bytes;
    OK(host_file_write("files/a", "x\0y", 3));
    OK(host_file_read("files/a", &text, &bytes));
    assert_int_equal(bytes, 3);
    assert_memory_equal(text, "x\0y", 3);
    free(text);
    assert_int_equal(files_in("files", ".part"), 0);
}

/* A full disk: the part is /dev/full, which takes no byte.  The older file stays, no part is left. */
static void full_disk_keeps_the_older_file(void **state)
{
    (void)state;
    fresh_folder("files");
    put("files/a", "old");
    assert_int_equal(symlink("/dev/full", "files/a.part"), 0);
    const status s = host_file_write("files/a", "new", 3);
    assert_int_equal(s.code, STATUS_IO);
    assert_non_null(strstr(s.text, "files/a"));
    assert_non_null(strstr(s.text, "No space left"));
    char *text;
    OK(host_file_read("files/a", &text, NULL));
    assert_string_equal(text, "old");
    free(text);
    assert_int_equal(files_in("files", ""), 1);
}

/* The same by pieces, small ones, and one that goes past the stream's buffer, whose rest is then not written later. */
static void full_disk_stops_a_stream(void **state)
{
    (void)state;
    const int sizes[] = { 100, 100000 };
    char text[100000];
    memset(text, 'x', sizeof text);
    for (int large = 0; large < 2; large++) {
        fresh_folder("files");
        put("files/a", "old");
        assert_int_equal(symlink("/dev/full", "files/a.part"), 0);
        file_writer w;
        OK(host_file_begin(&w, "files/a"));
        for (int k = 0; k < (large ? 1 : 100); k++) fprintf(w.stream, "%.*s", sizes[large], text);
        const status s = host_file_end(&w, true);
        assert_int_equal(s.code, STATUS_IO);
        if (!strstr(s.text, large ? "disk full" : "No space left")) fail_msg("%s", s.text);
        assert_int_equal(files_in("files", ""), 1);
    }
}

static void unwritable_places_are_named(void **state)
{
    (void)state;
    fresh_folder("files");
    put("files/plain", "not a folder");
    const char *const paths[] = { "files/nowhere/a", "files/plain/a", "/proc/breech/a" };
    for (size_t i = 0; i < 3; i++) {
        const status s = host_file_write(paths[i], "x", 1);
        assert_int_equal(s.code, STATUS_IO);
        assert_non_null(strstr(s.text, paths[i]));
    }
    char *text;
    assert_int_equal(host_file_read("files/nothing", &text, NULL).code, STATUS_IO);
    assert_null(text);
    assert_int_equal(host_file_read("files", &text, NULL).code, STATUS_IO);
}

/* ---- output directory ---- */

static void default_directory(void **state)
{
    (void)state;
    char path[64];
    OK(host_outdir_default("wu2017", path, sizeof path));
    assert_string_equal(path, "out/wu2017");
    OK(host_outdir_default("../a b", path, sizeof path));
    assert_string_equal(path, "out/..-a-b");
    OK(host_outdir_default("..", path, sizeof path));
    assert_string_equal(path, "out/case");
    assert_int_equal(
        host_outdir_default("a-name-that-does-not-fit-into-the-buffer-of-the-caller-at-all", path, 16).code, STATUS_IO);
}

static status open_and_close(outdir_options options, outdir_state *what)
{
    outdir d;
    const status s = host_outdir_open("run/deep", options, &d);
    if (s.code != STATUS_OK) return s;
    *what = d.state;
    host_outdir_close(&d);
    return s;
}

/* Every state of the directory against every option. */
static void rules_of_overwriting(void **state)
{
    (void)state;
    const outdir_options plain = { false, false }, force = { true, false }, resume = { false, true },
                         both = { true, true };
    outdir_state what;
    fresh_folder("run");
    OK(open_and_close(plain, &what));
    assert_int_equal(what, OUTDIR_NEW);
    OK(open_and_close(resume, &what)); /* nothing to resume: starts anew */
    assert_int_equal(what, OUTDIR_NEW);

    put("run/deep/summary.json", "{ \"status\": \"done\" }");
    put("run/deep/mine.txt", "not ours");
    const status finished = open_and_close(plain, &what);
    assert_int_equal(finished.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(finished.text, "--force"));
    assert_int_equal(files_in("run/deep", ""), 2);
    OK(open_and_close(resume, &what));
    assert_int_equal(what, OUTDIR_FINISHED);
    assert_int_equal(files_in("run/deep", ""), 2);

    put("run/deep/summary.json", "{ \"status\": \"stopped\" }");
    put("run/deep/checkpoint.bin", "x");
    const status stopped = open_and_close(plain, &what);
    assert_int_equal(stopped.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(stopped.text, "--resume"));
    OK(open_and_close(resume, &what));
    assert_int_equal(what, OUTDIR_RESUMED);
    assert_true(host_file_exists("run/deep/checkpoint.bin"));
    assert_int_equal(open_and_close(both, &what).code, STATUS_BAD_INPUT);

    assert_int_equal(
        system("mkdir -p run/deep/scenes/a && touch run/deep/scenes/a/scene-000001.hdf run/deep/plot-a.svg"), 0);
    OK(open_and_close(force, &what));
    assert_int_equal(what, OUTDIR_NEW);
    assert_int_equal(files_in("run/deep", ""), 1); /* the user's own file */
    assert_true(host_file_exists("run/deep/mine.txt"));

    put("run/deep/summary.json", "{ \"status\": \"failed\" }");
    OK(open_and_close(plain, &what)); /* a failed run may be repeated */
    assert_int_equal(what, OUTDIR_NEW);
}

/* Files of others with our names stay without --force; those of a run that was killed go, a part of ours too. */
static void foreign_files_stay(void **state)
{
    (void)state;
    const outdir_options plain = { false, false }, force = { true, false }, resume = { false, true };
    static const char *const names[] = { "report.html",
                                         "summary.json",
                                         "sweep.csv",
                                         "history.h5",
                                         "used.yaml",
                                         "plot-mine.svg",
                                         "scenes/a/scene-000001.hdf" };
    outdir_state what;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char path[100];
        fresh_folder("run");
        assert_int_equal(system("mkdir -p run/deep/scenes/a"), 0);
        snprintf(path, sizeof path, "run/deep/%s", names[k]);
        put(path, "name: mine");
        const status s = open_and_close(plain, &what);
        assert_int_equal(s.code, STATUS_BAD_INPUT);
        assert_non_null(strstr(s.text, names[k]));
        assert_int_equal(open_and_close(resume, &what).code, STATUS_BAD_INPUT);
        assert_true(host_file_exists(path));
        OK(open_and_close(force, &what));
        assert_false(host_file_exists(path));
    }
    put("run/deep/used.yaml", "# Run by: breech shot\nname: a\n");
    put("run/deep/report.html", "half a run's");
    put("run/deep/history.h5.part", "x");
    put("run/deep/mine.part", "x");
    put("run/deep/scene-plan.hdf", "x");
    OK(open_and_close(plain, &what));
    assert_int_equal(files_in("run/deep", ""), 2);
    put("run/deep/used.yaml.part", "# Run"); /* killed before its first file was whole */
    OK(open_and_close(plain, &what));
    assert_int_equal(files_in("run/deep", ""), 2);
}

static void one_run_at_a_time(void **state)
{
    (void)state;
    fresh_folder("run");
    outdir d, other;
    OK(host_outdir_open("run", (outdir_options){ false, false }, &d));
    const pid_t child = fork();
    if (child == 0)
        _exit(host_outdir_open("run", (outdir_options){ true, false }, &other).code == STATUS_BAD_INPUT ? 0 : 1);
    int result;
    waitpid(child, &result, 0);
    assert_int_equal(result, 0);
    host_outdir_close(&d);
    OK(host_outdir_open("run", (outdir_options){ false, false }, &other));
    host_outdir_close(&other);
}

static void directory_that_cannot_be(void **state)
{
    (void)state;
    fresh_folder("run");
    put("run/plain", "a file");
    outdir d;
    const status s = host_outdir_open("run/plain/deep", (outdir_options){ false, false }, &d);
    assert_int_equal(s.code, STATUS_IO);
    assert_non_null(strstr(s.text, "run/plain"));
    assert_int_equal(host_outdir_open("run/plain", (outdir_options){ false, false }, &d).code, STATUS_IO);
    assert_int_equal(host_outdir_open("/proc/breech", (outdir_options){ false, false }, &d).code, STATUS_IO);
}

static void scene_folders(void **state)
{
    (void)state;
    fresh_folder("run");
    outdir d;
    char path[OUTDIR_PATH_SIZE];
    OK(host_outdir_open("run", (outdir_options){ false, false }, &d));
    OK(host_outdir_scene(&d, "v1500-r0.5", path, sizeof path));
    assert_string_equal(path, "run/scenes/v1500-r0.5");
    assert_int_equal(access(path, W_OK), 0);
    assert_int_equal(host_outdir_scene(&d, "../a", path, sizeof path).code, STATUS_BAD_INPUT);
    assert_int_equal(host_outdir_scene(&d, "a b", path, sizeof path).code, STATUS_BAD_INPUT);
    host_outdir_close(&d);
}

/* ---- the machine ---- */

static void put_deep(const char *path, const char *text)
{
    char command[300];
    snprintf(command, sizeof command, "mkdir -p \"$(dirname '%s')\"", path);
    assert_int_equal(system(command), 0);
    put(path, text);
}

/* The least of what the machine, the group and all groups above it have, in both ways in which Linux says that. */
static void memory_of_machine_and_groups(void **state)
{
    (void)state;
    assert_true(host_memory("") > 1e8); /* this machine's */
    fresh_folder("root");
    assert_true(isinf(host_memory("root")));
    put_deep("root/proc/meminfo", "MemTotal:       16000000 kB\nMemFree:        1 kB\n");
    assert_true(host_memory("root") == 16000000.0 * 1024.0);
    put_deep("root/proc/self/cgroup", "0::/slice/job/step\n");
    put_deep("root/sys/fs/cgroup/slice/job/step/memory.max", "max\n");
    assert_true(host_memory("root") == 16000000.0 * 1024.0);
    put_deep("root/sys/fs/cgroup/slice/job/memory.max", "4000000000\n");
    assert_true(host_memory("root") == 4e9);
    put_deep("root/sys/fs/cgroup/memory.max", "3000000000\n"); /* as inside a container */
    assert_true(host_memory("root") == 3e9);
    put_deep("root/proc/self/cgroup", "9:name=systemd:/\n4:memory:/job\n0::/\n");
    put_deep("root/sys/fs/cgroup/memory/job/memory.limit_in_bytes", "2000000000\n");
    assert_true(host_memory("root") == 2e9);
    put_deep("root/sys/fs/cgroup/memory/job/memory.limit_in_bytes", "9223372036854771712\n"); /* none */
    assert_true(host_memory("root") == 3e9);
}

/* ---- checkpoint ---- */

enum { IMAGE = 1000 };

static checkpoint example_checkpoint(const char *image)
{
    checkpoint c = { .scene_hash = 77,
                     .scene_time = 1.0 / 3.0,
                     .wall_seconds = 12.5,
                     .study = "study",
                     .study_bytes = 6,
                     .image = image,
                     .image_bytes = IMAGE };
    strcpy(c.scene, "v1500");
    return c;
}

static void checkpoint_comes_back(void **state)
{
    (void)state;
    fresh_folder("check");
    char image[IMAGE];
    for (int i = 0; i < IMAGE; i++) image[i] = (char)(i * 7);
    const checkpoint c = example_checkpoint(image);
    const checkpoint_key key = run_checkpoint_key_of("x86-64-v3", 99);
    checkpoint back;
    OK(run_checkpoint_write("check/a", &key, &c));
    OK(run_checkpoint_read("check/a", &key, &back));
    assert_string_equal(back.scene, "v1500");
    assert_true(back.scene_time == c.scene_time && back.wall_seconds == 12.5 && back.scene_hash == 77);
    assert_int_equal(back.image_bytes, IMAGE);
    assert_memory_equal(back.image, image, IMAGE);
    assert_memory_equal(back.study, "study", 6);
    run_checkpoint_free(&back);

    const checkpoint empty = { .wall_seconds = 1.0 };
    OK(run_checkpoint_write("check/a", &key, &empty));
    OK(run_checkpoint_read("check/a", &key, &back));
    assert_null(back.image);
    assert_null(back.study);
    assert_string_equal(back.scene, "");
    run_checkpoint_free(&back);
}

static void foreign_checkpoint_is_refused(void **state)
{
    (void)state;
    fresh_folder("check");
    char image[IMAGE] = { 1 };
    const checkpoint c = example_checkpoint(image);
    const checkpoint_key key = run_checkpoint_key_of("x86-64-v3", 99);
    OK(run_checkpoint_write("check/a", &key, &c));
    checkpoint back;

    const checkpoint_key other_set = run_checkpoint_key_of("x86-64-v4", 99),
                         other_case = run_checkpoint_key_of("x86-64-v3", 98);
    checkpoint_key other_version = key, other_build = key;
    strcpy(other_version.version, "9.9.9");
    char *solver = strstr(other_build.version, run_solver_id()); /* the same version from other sources */
    assert_non_null(solver);
    solver[0] = solver[0] == '0' ? '1' : '0';
    const struct {
        const checkpoint_key *key;
        const char *word;
    } foreign[] = { { &other_set, "instruction set" },
                    { &other_case, "another case" },
                    { &other_version, "version" },
                    { &other_build, run_solver_id() } };
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        const status s = run_checkpoint_read("check/a", foreign[i].key, &back);
        assert_int_equal(s.code, STATUS_BAD_INPUT);
        assert_non_null(strstr(s.text, foreign[i].word));
        assert_null(back.image);
    }
    put("check/b", "something else");
    const status s = run_checkpoint_read("check/b", &key, &back);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(s.text, "not a checkpoint"));
    assert_int_equal(run_checkpoint_read("check/nothing", &key, &back).code, STATUS_IO);
}

/* Each byte of the file changed in turn, and each shorter length: never accepted. */
static void damage_is_found_in_every_byte(void **state)
{
    (void)state;
    fresh_folder("check");
    char image[IMAGE] = { 1 }, *data;
    size_t bytes;
    const checkpoint c = example_checkpoint(image);
    const checkpoint_key key = run_checkpoint_key_of("x86-64-v3", 99);
    OK(run_checkpoint_write("check/a", &key, &c));
    OK(host_file_read("check/a", &data, &bytes));
    checkpoint back;
    for (size_t i = 0; i < bytes; i++) {
        data[i] = (char)(data[i] ^ (1 << i % 8));
        FILE *f = fopen("check/b", "wb");
        fwrite(data, 1, bytes, f);
        fclose(f);
        data[i] = (char)(data[i] ^ (1 << i % 8));
        if (run_checkpoint_read("check/b", &key, &back).code == STATUS_OK)
            fail_msg("byte %zu changed, and accepted", i);
    }
    for (size_t n = 0; n < bytes; n += 37) {
        FILE *f = fopen("check/b", "wb");
        fwrite(data, 1, n, f);
        fclose(f);
        assert_int_equal(run_checkpoint_read("check/b", &key, &back).code, STATUS_BAD_INPUT);
    }
    free(data);
}

/* A process that may write no more than 64 KiB a file: the new checkpoint fails, the older one still reads. */
static void checkpoint_survives_a_full_disk(void **state)
{
    (void)state;
    fresh_folder("check");
    char image[IMAGE] = { 1 };
    checkpoint c = example_checkpoint(image), back;
    const checkpoint_key key = run_checkpoint_key_of("x86-64-v3", 99);
    OK(run_checkpoint_write("check/a", &key, &c));
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const struct rlimit limit = { 65536, 65536 };
        setrlimit(RLIMIT_FSIZE, &limit);
        c.image = calloc(1, 1 << 20);
        c.image_bytes = 1 << 20;
        _exit(run_checkpoint_write("check/a", &key, &c).code == STATUS_IO ? 0 : 1);
    }
    int result;
    waitpid(child, &result, 0);
    assert_int_equal(result, 0);
    assert_int_equal(files_in("check", ".part"), 0);
    OK(run_checkpoint_read("check/a", &key, &back));
    assert_int_equal(back.image_bytes, IMAGE);
    run_checkpoint_free(&back);
}

static void hash_sees_every_bit_and_the_length(void **state)
{
    (void)state;
    unsigned char data[40] = { 0 };
    const uint64_t zero = host_hash_bytes(0, data, sizeof data);
    for (size_t i = 0; i < 8 * sizeof data; i++) {
        data[i / 8] ^= (unsigned char)(1 << i % 8);
        assert_true(host_hash_bytes(0, data, sizeof data) != zero);
        data[i / 8] ^= (unsigned char)(1 << i % 8);
    }
    for (size_t n = 0; n < sizeof data; n++) assert_true(host_hash_bytes(0, data, n) != zero);
    assert_true(host_hash_bytes(1, data, sizeof data) != zero);
    assert_true(host_hash_bytes(0, data, sizeof data) == zero);
}

/* ---- progress, tables, stop ---- */

static void durations(void **state)
{
    (void)state;
    const struct {
        double s;
        const char *text;
    } cases[] = { { 0.0, "0 s" },         { 59.4, "59 s" },         { 59.6, "1 min 00 s" },
                  { 80.0, "1 min 20 s" }, { 7500.0, "2 h 05 min" }, { 273600.0, "3 d 04 h" },
                  { -1.0, "unknown" },    { NAN, "unknown" },       { INFINITY, "unknown" } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[32];
        host_duration_text(cases[i].s, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

static void progress_line(void **state)
{
    (void)state;
    progress p = { .fraction_started = 0.0 };
    strcpy(p.task, "scene 3 of 8");
    char text[200];
    host_progress_text(&p, 0.25, 10.0, 312000000, text, sizeof text);
    assert_string_equal(text, "scene 3 of 8  25 %  30 s left  31.2 M point-steps/s");
    host_progress_text(&p, 0.0, 0.0, 0, text, sizeof text);
    assert_string_equal(text, "scene 3 of 8  0 %");
    host_progress_text(&p, 0.999, 10.0, 0, text, sizeof text); /* not 100 % before it is done */
    assert_non_null(strstr(text, " 99 %"));
    p.fraction_started = 0.5; /* resumed at one half: the rest takes as long as the gained half */
    p.steps_started = 100000000;
    host_progress_text(&p, 0.75, 10.0, 200000000, text, sizeof text);
    assert_string_equal(text, "scene 3 of 8  75 %  10 s left  10.0 M point-steps/s");
    char small[12];
    host_progress_text(&p, 0.75, 10.0, 200000000, small, sizeof small);
    assert_int_equal(strlen(small), sizeof small - 1);
}

/* To a file: no control characters, nothing within ten seconds; quiet: warnings alone. */
static void progress_on_no_terminal(void **state)
{
    (void)state;
    for (int quiet = 0; quiet < 2; quiet++) {
        FILE *f = tmpfile();
        assert_non_null(f);
        progress p;
        host_progress_open(&p, f, quiet);
        host_progress_task(&p, "scene", 0.0, 0);
        host_progress_update(&p, 0.1, 1000);
        assert_int_equal(ftell(f), 0);
        p.last_shown -= 11.0; /* as if eleven seconds had gone by */
        host_progress_update(&p, 0.2, 1000);
        host_progress_say(&p, "site %d passed", 4);
        host_progress_warn(&p, "%d cells", 2);
        host_progress_close(&p);
        char text[300] = "";
        rewind(f);
        const size_t n = fread(text, 1, sizeof text - 1, f);
        fclose(f);
        if (quiet) {
            assert_string_equal(text, "warning: 2 cells\n");
            assert_int_equal(n, strlen(text));
        } else {
            assert_null(strchr(text, '\r'));
            assert_non_null(strstr(text, "scene  20 %"));
            assert_non_null(strstr(text, "site 4 passed\nwarning: 2 cells\n"));
        }
    }
}

static void timing_books_every_second(void **state)
{
    (void)state;
    timing t;
    host_timing_open(&t);
    host_timing_add(&t, "shot", 1.0);
    host_timing_add(&t, "scenes", 2.0);
    host_timing_add(&t, "shot", 0.5);
    assert_int_equal(t.phases, 2);
    assert_true(t.phase[0].seconds == 1.5 && t.phase[0].calls == 2);
    for (int i = 0; i < 3 * TIMING_MAX_PHASES; i++) {
        char name[16];
        snprintf(name, sizeof name, "phase %d", i);
        host_timing_add(&t, name, 1.0);
    }
    double sum = 0.0;
    for (int i = 0; i < t.phases; i++) sum += t.phase[i].seconds;
    assert_int_equal(t.phases, TIMING_MAX_PHASES);
    assert_true(sum == 3.5 + 3 * TIMING_MAX_PHASES); /* small integers and halves: exact */
    char *text = NULL;
    size_t bytes;
    FILE *out = open_memstream(&text, &bytes);
    host_timing_print(&t, out);
    fclose(out);
    assert_non_null(strstr(text, "others"));
    assert_non_null(strstr(text, "total"));
    free(text);
}

/* A long path does not push out what is wrong with it. */
static void long_paths_leave_the_reason(void **state)
{
    (void)state;
    char path[700], *text;
    size_t length;
    memset(path, 'p', sizeof path - 1);
    path[sizeof path - 1] = '\0';
    const status s = host_file_text(path, 100, &text, &length);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(s.text, "cannot be opened: File name too long"));
}

static void table_is_aligned(void **state)
{
    (void)state;
    table *t;
    OK(host_table_create("site|v [m/s]|class", &t));
    OK(host_table_row(t, "a|%d|%s", 1500, "gouge"));
    OK(host_table_row(t, "b \xc2\xb5m|-|none"));
    assert_int_equal(host_table_row(t, "a|b|c|d").code, STATUS_BAD_INPUT);
    char *text = NULL;
    size_t bytes;
    FILE *out = open_memstream(&text, &bytes);
    host_table_print(t, out);
    fclose(out);
    assert_string_equal(text, "site  v [m/s]  class\na        1500  gouge\nb \xc2\xb5m        -  none\n");
    free(text);
    host_table_free(t);
    /* more columns stand again below where that is asked for */
    OK(host_table_create(
        "charge|mass|a column of thirty characters|another that has that many too|and a third of some length|"
        "the last",
        &t));
    OK(host_table_row(t, "1|2|3|4|5|6"));
    host_table_keep(t, 2);
    out = open_memstream(&text, &bytes);
    host_table_print(t, out);
    fclose(out);
    assert_non_null(strstr(text, "\n\ncharge  mass  "));
    free(text);
    host_table_free(t);
    /* wider than a hundred columns: the rest below, with the first column */
    OK(host_table_create("name|a column of thirty characters|another that has that many too|and a third of some length|"
                         "the last",
                         &t));
    OK(host_table_row(t, "row|1|2|3|4"));
    out = open_memstream(&text, &bytes);
    host_table_print(t, out);
    fclose(out);
    assert_non_null(strstr(text, "and a third of some length\nrow "));
    assert_non_null(strstr(text, "\n\nname  the last\nrow          4\n"));
    free(text);
    host_table_free(t);
    char titles[2 * TABLE_MAX_COLUMNS + 2] = "1"; /* one column more than there may be */
    for (int k = 0; k < TABLE_MAX_COLUMNS; k++) strcat(titles, "|k");
    assert_int_equal(host_table_create(titles, &t).code, STATUS_BAD_INPUT);
}

/* Any text may stand in a cell: a long one ends between two characters, and a bar begins no new cell. */
static void table_takes_any_text(void **state)
{
    (void)state;
    table *t;
    char longest[96] = "", longer[2000] = "", *text = NULL;
    size_t bytes;
    memset(longest, 'n', 95);
    memset(longer, 'm', 91);
    for (size_t k = 91; k < 1901; k += 2) memcpy(longer + k, "\xc2\xb5", 2);
    OK(host_table_create("name" TABLE_NEXT "what|more", &t));
    OK(host_table_row(t, "%s|c", "a" TABLE_NEXT "b"));
    assert_int_equal(host_table_row(t, "%s|c|d", "a" TABLE_NEXT "b").code, STATUS_BAD_INPUT);
    OK(host_table_row(t, "%s|%s", "a|b|c", "two\nlines"));
    OK(host_table_row(t, "%s|x", longest));
    OK(host_table_row(t, "%s|after", longer));
    FILE *out = open_memstream(&text, &bytes);
    host_table_print(t, out);
    fclose(out);
    assert_non_null(strstr(text, "\na|b|c"));
    assert_non_null(strstr(text, "two lines"));
    assert_non_null(strstr(text, longest));
    assert_non_null(strstr(text, "m...  ")); /* 91 of m, no half of a character, three dots */
    assert_non_null(strstr(text, "after"));
    free(text);
    host_table_free(t);
}

static void signals_ask_to_stop(void **state)
{
    (void)state;
    host_stop_install(host_wall_clock(), NAN);
    assert_false(host_stop_requested());
    assert_string_equal(host_stop_reason(), "");
    raise(SIGTERM);
    assert_true(host_stop_requested());
    assert_string_equal(host_stop_reason(), "SIGTERM");
    host_stop_install(host_wall_clock(), INFINITY);
    assert_false(host_stop_requested());
    raise(SIGINT);
    assert_string_equal(host_stop_reason(), "SIGINT");
    host_stop_install(host_wall_clock(), 1e-3);
    usleep(3000);
    assert_true(host_stop_requested());
    assert_string_equal(host_stop_reason(), "--max-walltime reached");
    host_stop_install(host_wall_clock(), 3600.0);
    assert_false(host_stop_requested());
}

static void second_interrupt_ends_it(void **state)
{
    (void)state;
    const pid_t child = fork();
    if (child == 0) {
        host_stop_install(host_wall_clock(), NAN);
        raise(SIGINT);
        raise(SIGINT);
        _exit(0);
    }
    int result;
    waitpid(child, &result, 0);
    assert_int_equal(WEXITSTATUS(result), 128 + SIGINT);
}

/* ---- in the background ---- */

/* A pipe takes the first file only when it is read: until then the caller goes on, and the second is not there. */
static void files_are_written_behind_the_caller(void **state)
{
    (void)state;
    fresh_folder("behind");
    assert_int_equal(mkfifo("behind/a.part", 0666), 0);
    background b = { .started = false };
    OK(host_background_wait(&b));
    const background_file file[BACKGROUND_FILES] = { { "behind/a", "one", 3 }, { "behind/b", "two", 3 } };
    host_background_start(&b, file);
    assert_false(host_file_exists("behind/a") || host_file_exists("behind/b"));
    char text[4] = "";
    FILE *reader = fopen("behind/a.part", "r");
    assert_int_equal(fread(text, 1, 3, reader), 3);
    assert_string_equal(text, "one");
    const status pipe = host_background_wait(&b); /* which cannot be synchronised */
    fclose(reader);
    assert_int_equal(pipe.code, STATUS_IO);
    assert_false(host_file_exists("behind/b")); /* what comes behind one that failed is not written */
    OK(host_background_wait(&b));
    host_background_start(&b, file);
    OK(host_background_wait(&b));
    assert_true(host_file_exists("behind/a") && host_file_exists("behind/b"));
    assert_int_equal(files_in("behind", ".part"), 0);
}

/* A signal of the process comes to the thread that asks for it, not to the one that writes: while this one does not
 * take it, nobody does. */
static void signals_leave_the_writer_alone(void **state)
{
    (void)state;
    sigset_t stop, before;
    fresh_folder("behind");
    assert_int_equal(mkfifo("behind/a.part", 0666), 0);
    host_stop_install(host_wall_clock(), NAN);
    sigemptyset(&stop), sigaddset(&stop, SIGTERM);
    background b = { .started = false };
    host_background_start(&b, (background_file[BACKGROUND_FILES]){ { "behind/a", "", 0 }, { "behind/b", "", 0 } });
    pthread_sigmask(SIG_BLOCK, &stop, &before);
    kill(getpid(), SIGTERM);
    usleep(20000);
    assert_false(host_stop_requested());
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    assert_true(host_stop_requested());
    fclose(fopen("behind/a.part", "r"));
    host_background_wait(&b);
    host_stop_install(host_wall_clock(), NAN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(file_comes_back),
        cmocka_unit_test(full_disk_keeps_the_older_file),
        cmocka_unit_test(full_disk_stops_a_stream),
        cmocka_unit_test(unwritable_places_are_named),
        cmocka_unit_test(default_directory),
        cmocka_unit_test(rules_of_overwriting),
        cmocka_unit_test(foreign_files_stay),
        cmocka_unit_test(one_run_at_a_time),
        cmocka_unit_test(directory_that_cannot_be),
        cmocka_unit_test(scene_folders),
        cmocka_unit_test(memory_of_machine_and_groups),
        cmocka_unit_test(checkpoint_comes_back),
        cmocka_unit_test(foreign_checkpoint_is_refused),
        cmocka_unit_test(damage_is_found_in_every_byte),
        cmocka_unit_test(checkpoint_survives_a_full_disk),
        cmocka_unit_test(hash_sees_every_bit_and_the_length),
        cmocka_unit_test(durations),
        cmocka_unit_test(progress_line),
        cmocka_unit_test(progress_on_no_terminal),
        cmocka_unit_test(timing_books_every_second),
        cmocka_unit_test(long_paths_leave_the_reason),
        cmocka_unit_test(table_is_aligned),
        cmocka_unit_test(table_takes_any_text),
        cmocka_unit_test(signals_ask_to_stop),
        cmocka_unit_test(second_interrupt_ends_it),
        cmocka_unit_test(files_are_written_behind_the_caller),
        cmocka_unit_test(signals_leave_the_writer_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
