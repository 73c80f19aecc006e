/* SPDX-License-Identifier: BSD-3-Clause */
/* history.h5: what was appended comes back, with units; a run that goes on leaves no gap; nothing that ends the writer
 * leaves a file that cannot be read. */
#include "output_common.h"

#include "coupling/gouge/crater_history.h"
#include "coupling/host/hdf5_file.h"
#include "coupling/output/history.h"

#include <signal.h>
#include <sys/wait.h>
#include <time.h>

static const history_column two[] = { { "time", "s", "time" }, { "x", "m", "position" } };

static void append_many(history *h, int series, int from, int to)
{
    for (int i = from; i < to; i++) OK(output_history_append(h, series, (const double[]){ 1e-6 * i, 2.0 * i }));
}

static double *read_series(const char *path, const char *name, size_t *n)
{
    h5_file *f;
    double *data;
    size_t dims[H5_MAX_RANK];
    OK(host_h5_open(path, &f));
    OK(host_h5_read(f, name, &data, dims));
    host_h5_close(f);
    *n = dims[0];
    return data;
}

/* 1000 rows: more than one buffer, less than a whole number of them. */
static void rows_come_back(void **state)
{
    (void)state;
    fresh_folder("history");
    history *h;
    int series, again;
    OK(output_history_open("history/a.h5", false, &h));
    OK(output_history_series(h, "/scene/a", two, 2, &series));
    append_many(h, series, 0, 1000);
    OK(output_history_series(h, "/scene/a", two, 2, &again));
    assert_int_equal(series, again);
    OK(output_history_close(h));
    size_t n;
    double *x = read_series("history/a.h5", "/scene/a/x", &n);
    assert_int_equal(n, 1000);
    for (int i = 0; i < 1000; i++) assert_true(x[i] == 2.0 * i);
    free(x);
    assert_int_equal(files_in("history", ""), 1);
}

/* A shot's row and event, a scene's row and its crater, whose map has 4 x 3 depths. */
static void write_one_of_each(double map[12])
{
    history *h;
    int series;
    OK(output_history_open("history/a.h5", false, &h));
    OK(output_history_shot(h, &series));
    double row[HISTORY_MAX_COLUMNS];
    circuit_shot_state s;
    memset(&s, 0, sizeof s);
    s.t = 1e-3;
    s.v = 1234.5;
    s.ledger.energy_error = 7e-9;
    output_history_shot_row(&s, row);
    OK(output_history_append(h, series, row));
    OK(output_history_events(h, &series));
    const circuit_shot_event e = { CIRCUIT_SHOT_SITE, 3, s };
    output_history_event_row(&e, row);
    OK(output_history_append(h, series, row));
    const history_column more = { "speed", "m/s", "of the caller's" };
    OK(output_history_scene(h, "v1500", &more, 1, &series));
    mpm_report report;
    mpm_ledger ledger;
    memset(&report, 0, sizeof report);
    memset(&ledger, 0, sizeof ledger);
    report.failed_volume = 5.0;
    *output_history_scene_row(&report, &ledger, (const double[3]){ 7.0, 8.0, 9.0 }, row) = 11.0;
    OK(output_history_append(h, series, row));
    const scene_result r = {
        .class = DAMAGE_GOUGE, .reason = "grows", .crater_class = DAMAGE_SCRATCH, .crater_reason = "ends"
    };
    const crater c = {
        .severity = 0.5, .nx = 4, .nz = 3, .x0 = 1e-3, .dx = 1e-4, .z0 = -1e-4, .dz = 1e-4, .depth_map = map
    };
    OK(gouge_crater_record(&c, &r, h, "v1500"));
    OK(gouge_crater_record(&c, &r, h, "v1500")); /* a former one is replaced */
    OK(output_history_close(h));
}

static void every_column_has_units_and_description(void **state)
{
    (void)state;
    static const struct {
        const char *series;
        double is;
    } written[] = {
        { "/shot/velocity", 1234.5 },          { "/shot/events/index", 3.0 },
        { "/scene/v1500/failed_volume", 5.0 }, { "/scene/v1500/contact_force_y", 8.0 },
        { "/scene/v1500/speed", 11.0 },
    };
    double map[12];
    size_t n;
    for (int i = 0; i < 12; i++) map[i] = 1e-4 * i;
    fresh_folder("history");
    write_one_of_each(map);
    for (size_t k = 0; k < sizeof written / sizeof *written; k++) {
        double *v = read_series("history/a.h5", written[k].series, &n);
        if (n != 1 || v[0] != written[k].is) fail_msg("%s: %zu rows", written[k].series, n);
        free(v);
    }
    double *depth = read_series("history/a.h5", "/scene/v1500/crater/depth", &n);
    assert_true(n == 4 && depth[11] == map[11]);
    free(depth);
    run_script("read_history.py", "history/a.h5");
}

/* A real shot of two groups: what the file holds is what the shot says. */
typedef struct {
    history *h;
    int series, modules;
    double current, voltage; /* of the last sample, group 1 */
    size_t n;
} shot_writer;

static bool write_sample(void *user, const circuit_shot *s, const circuit_shot_state *state)
{
    shot_writer *w = user;
    double row[HISTORY_MAX_COLUMNS];
    output_history_shot_row(state, row);
    OK(output_history_append(w->h, w->series, row));
    output_history_modules_row(s, row);
    OK(output_history_append(w->h, w->modules, row));
    w->current = circuit_shot_module_current(s, 1);
    w->voltage = circuit_shot_module_voltage(s, 1);
    w->n++;
    return true;
}

static circuit_shot *two_groups(void)
{
    circuit_shot_module module[2];
    for (int g = 0; g < 2; g++) {
        base_params_default(circuit_supply_capacitor_params, &module[g]);
        module[g].count = g + 1;
        module[g].capacitance = 3.594e-3;
        module[g].charge = 10e3;
        module[g].inductance = 12.56e-6;
        module[g].resistance = 4.1e-3;
        module[g].fire_at = 1e-4 * g;
    }
    circuit_shot_config c = { .supplies = { [CIRCUIT_SUPPLY_capacitor] = { 2, module } } };
    base_params_default(circuit_shot_rails_params, &c.rails);
    base_params_default(circuit_shot_barrel_params, &c.barrel);
    base_params_default(circuit_shot_armature_params, &c.armature);
    base_params_default(circuit_shot_options_params, &c.options);
    c.rails.level = CIRCUIT_SHOT_RAILS_CONSTANT;
    c.rails.height = c.rails.separation = 0.025;
    c.rails.thickness = 0.02;
    c.rails.inductance_gradient = 0.5e-6;
    c.rails.resistance_gradient = 1e-4;
    c.barrel.length = 1.0;
    c.barrel.start = 0.1;
    c.armature.mass = 0.1;
    circuit_shot *s;
    OK(circuit_shot_create(&c, &s));
    return s;
}

static void real_shot_comes_back(void **state)
{
    (void)state;
    fresh_folder("history");
    circuit_shot *s = two_groups();
    shot_writer w = { .n = 0 };
    OK(output_history_open("history/a.h5", false, &w.h));
    OK(output_history_shot(w.h, &w.series));
    OK(output_history_modules(w.h, s, &w.modules));
    OK(circuit_shot_advance(s, 1e-3, &(circuit_shot_sink){ .sample = write_sample, .user = &w }));
    OK(output_history_close(w.h));
    const circuit_shot_state now = circuit_shot_now(s);
    circuit_shot_free(s);
    assert_true(w.n > 20);
    const struct {
        const char *name;
        double last;
    } columns[] = { { "/shot/time", now.t },
                    { "/shot/current", now.current },
                    { "/shot/heat_rails", now.ledger.rails_heat },
                    { "/shot/modules/time", now.t },
                    { "/shot/modules/current_001", w.current },
                    { "/shot/modules/voltage_001", w.voltage } };
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
        size_t n;
        double *data = read_series("history/a.h5", columns[i].name, &n);
        assert_int_equal(n, w.n);
        assert_true(data[n - 1] == columns[i].last); /* doubles, copied */
        free(data);
    }
}

static void names_that_are_no_names(void **state)
{
    (void)state;
    fresh_folder("history");
    history *h;
    int series;
    OK(output_history_open("history/a.h5", false, &h));
    assert_int_equal(output_history_scene(h, "a/b", NULL, 0, &series).code, STATUS_BAD_INPUT);
    assert_int_equal(output_history_series(h, "/a", two, 0, &series).code, STATUS_BAD_INPUT);
    assert_int_equal(output_history_series(h, "a", two, 2, &series).code, STATUS_BAD_INPUT);
    assert_int_equal(output_history_scene(h, "a", two, HISTORY_MAX_COLUMNS, &series).code, STATUS_BAD_INPUT);
    OK(output_history_close(h));
}

/* As many series and columns as a scene has probes and bodies; the place of one that has ended is the next one's. */
static void takes_any_number(void **state)
{
    (void)state;
    enum { MANY = 5000 };
    static char name[MANY][16];
    static history_column column[MANY];
    static double row[MANY];
    fresh_folder("history");
    history *h;
    int series;
    OK(output_history_open("history/a.h5", false, &h));
    for (int i = 0; i < 600; i++) {
        char group[16];
        snprintf(group, sizeof group, "/s%d", i);
        OK(output_history_series(h, group, two, 2, &series));
        assert_int_equal(series, i);
    }
    append_many(h, 599, 0, 3);
    OK(output_history_end(h, 5));
    for (int i = 0; i < MANY; i++) {
        snprintf(name[i], sizeof name[i], "c%d", i);
        column[i] = (history_column){ name[i], "1", "number" };
        row[i] = i;
    }
    OK(output_history_series(h, "/more", column, MANY, &series));
    assert_int_equal(series, 5);
    OK(output_history_append(h, series, row));
    OK(output_history_close(h));
    size_t n;
    double *x = read_series("history/a.h5", "/s599/x", &n), *last = read_series("history/a.h5", "/more/c4999", &n);
    assert_true(x[2] == 4.0 && n == 1 && last[0] == MANY - 1);
    free(x), free(last);
}

/* A run stopped at row 500 with rows flushed up to 700 goes on from its checkpoint: each time once, in order. */
static void resumed_run_has_no_gap_and_no_double(void **state)
{
    (void)state;
    fresh_folder("history");
    history *h;
    int series;
    OK(output_history_open("history/a.h5", false, &h));
    OK(output_history_series(h, "/scene/a", two, 2, &series));
    append_many(h, series, 0, 700);
    OK(output_history_close(h));
    OK(output_history_open("history/a.h5", true, &h));
    OK(output_history_series(h, "/scene/a", two, 2, &series));
    OK(output_history_rewind(h, series, 1e-6 * 499));
    append_many(h, series, 500, 1200);
    OK(output_history_close(h));
    size_t n;
    double *t = read_series("history/a.h5", "/scene/a/time", &n), *x = read_series("history/a.h5", "/scene/a/x", &n);
    assert_int_equal(n, 1200);
    for (int i = 0; i < 1200; i++) assert_true(t[i] == 1e-6 * i && x[i] == 2.0 * i);
    free(t);
    free(x);
    OK(output_history_open("history/a.h5", false, &h)); /* without --resume: replaced */
    OK(output_history_close(h));
    h5_file *f;
    OK(host_h5_open("history/a.h5", &f));
    assert_false(host_h5_exists(f, "/scene"));
    host_h5_close(f);
}

static void write_for_ever(void)
{
    history *h;
    int series;
    if (output_history_open("history/a.h5", false, &h).code != STATUS_OK) _exit(3);
    if (output_history_series(h, "/scene/a", two, 2, &series).code != STATUS_OK) _exit(4);
    for (int i = 0;; i++) {
        if (output_history_append(h, series, (const double[]){ 1e-6 * i, 2.0 * i }).code != STATUS_OK) _exit(5);
        if (i % 40 == 0 && output_history_flush(h).code != STATUS_OK) _exit(6);
    }
}

/* kill -9 at any instant, the middle of a flush included: what is there is a whole file with the rows of some flush. */
static void killed_writer_leaves_a_readable_file(void **state)
{
    (void)state;
    const int kills = full_tests() ? 300 : 25;
    size_t longest = 0;
    for (int k = 0; k < kills; k++) {
        fresh_folder("history");
        const pid_t child = fork();
        if (child == 0) write_for_ever();
        while (access("history/a.h5", R_OK) != 0) usleep(200);
        usleep((useconds_t)(1000 + (k * 7919) % 40000));
        kill(child, SIGKILL);
        int result;
        waitpid(child, &result, 0);
        assert_true(WIFSIGNALED(result));
        size_t nt, nx;
        double *t = read_series("history/a.h5", "/scene/a/time", &nt),
               *x = read_series("history/a.h5", "/scene/a/x", &nx);
        assert_int_equal(nt, nx);
        assert_int_equal(nt % 40, 1); /* as flushed */
        for (size_t i = 0; i < nt; i++) assert_true(t[i] == 1e-6 * (double)i && x[i] == 2.0 * (double)i);
        if (nt > longest) longest = nt;
        free(t);
        free(x);
    }
    assert_true(longest > 41); /* some were killed well into their work */
}

static void full_disk_is_an_error_and_keeps_the_file(void **state)
{
    (void)state;
    fresh_folder("history");
    history *h;
    int series;
    OK(output_history_open("history/a.h5", false, &h));
    OK(output_history_series(h, "/scene/a", two, 2, &series));
    append_many(h, series, 0, 10);
    OK(output_history_flush(h));
    append_many(h, series, 10, 20);
    assert_int_equal(symlink("/dev/full", "history/a.h5.part"), 0);
    const status s = output_history_flush(h);
    assert_int_equal(s.code, STATUS_IO);
    assert_non_null(strstr(s.text, "history/a.h5"));
    size_t n;
    free(read_series("history/a.h5", "/scene/a/time", &n));
    assert_int_equal(n, 10);
    OK(output_history_close(h)); /* there is room again: nothing is lost */
    free(read_series("history/a.h5", "/scene/a/time", &n));
    assert_int_equal(n, 20);
}

static void foreign_files_are_refused(void **state)
{
    (void)state;
    fresh_folder("history");
    FILE *out = fopen("history/a.h5", "w");
    fputs("no HDF5", out);
    fclose(out);
    history *h;
    const status s = output_history_open("history/a.h5", true, &h);
    assert_int_equal(s.code, STATUS_IO);
    assert_non_null(strstr(s.text, "history/a.h5"));
    assert_null(h);
    h5_file *f;
    assert_int_equal(host_h5_open("history/none.h5", &f).code, STATUS_IO);
    OK(host_h5_create(&f));
    double *data;
    size_t dims[H5_MAX_RANK];
    assert_int_equal(host_h5_read(f, "/nothing/here", &data, dims).code, STATUS_IO);
    assert_null(data);
    assert_int_equal(host_h5_truncate(f, "/nothing", 3).code, STATUS_IO);
    host_h5_close(f);
}

/* Two files open at once do not see each other. */
static void files_in_memory_are_apart(void **state)
{
    (void)state;
    h5_file *a, *b;
    const double one = 1.0;
    OK(host_h5_create(&a));
    OK(host_h5_create(&b));
    OK(host_h5_write(a, &(h5_name){ "/x", "m", "one" }, &(h5_array){ H5_DOUBLE, 1, { 1 }, &one }));
    assert_true(host_h5_exists(a, "/x"));
    assert_false(host_h5_exists(b, "/x"));
    char *names, unit[8];
    OK(host_h5_list(a, "/", &names));
    assert_string_equal(names, "x\n");
    free(names);
    OK(host_h5_read_attribute_text(a, "/x", "units", unit, sizeof unit));
    assert_string_equal(unit, "m");
    host_h5_close(a);
    host_h5_close(b);
}

/* A file of another origin, as a shared store may have: nothing is read past what is there, or past the room. */
static void other_forms_are_refused(void **state)
{
    (void)state;
    h5_file *f;
    const int64_t three[] = { 1, 2, 3 };
    const double minus = -1.0;
    double number[3] = { 0.0, 7.0, 8.0 };
    char *text;
    OK(host_h5_create(&f));
    OK(host_h5_attribute_ints(f, "/", "one", three, 1));
    OK(host_h5_attribute_ints(f, "/", "three", three, 3));
    OK(host_h5_read_attribute_double(f, "/", "one", number));
    assert_true(number[0] == 1.0);
    assert_int_equal(host_h5_read_attribute_double(f, "/", "three", number).code, STATUS_IO);
    assert_true(number[0] == 1.0 && number[1] == 7.0 && number[2] == 8.0);
    OK(host_h5_write_text(f, "/text", NULL, "a b"));
    OK(host_h5_read_text(f, "/text", &text));
    assert_string_equal(text, "a b");
    free(text);
    OK(host_h5_write(f, &(h5_name){ "/rows", NULL, NULL }, &(h5_array){ H5_UINT8, 2, { 1000000, 0 }, "" }));
    OK(host_h5_write(f, &(h5_name){ "/minus", NULL, NULL }, &(h5_array){ H5_DOUBLE, 1, { 1 }, &minus }));
    const char *const no_text[] = { "/rows", "/minus", "/nothing" };
    for (size_t i = 0; i < sizeof no_text / sizeof *no_text; i++) {
        const status s = host_h5_read_text(f, no_text[i], &text);
        assert_int_equal(s.code, STATUS_IO);
        assert_non_null(strstr(s.text, no_text[i]));
        assert_null(text);
    }
    host_h5_close(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_come_back),
        cmocka_unit_test(every_column_has_units_and_description),
        cmocka_unit_test(real_shot_comes_back),
        cmocka_unit_test(names_that_are_no_names),
        cmocka_unit_test(takes_any_number),
        cmocka_unit_test(resumed_run_has_no_gap_and_no_double),
        cmocka_unit_test(killed_writer_leaves_a_readable_file),
        cmocka_unit_test(full_disk_is_an_error_and_keeps_the_file),
        cmocka_unit_test(foreign_files_are_refused),
        cmocka_unit_test(files_in_memory_are_apart),
        cmocka_unit_test(other_forms_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
