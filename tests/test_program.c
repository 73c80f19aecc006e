/* SPDX-License-Identifier: BSD-3-Clause */
/* The program from outside: exit codes, refusals that write nothing, --set, summaries. */
#include "full_common.h"
#include "program_common.h"

/* ---- usage ---- */

static void test_usage(void **state)
{
    (void)state;
    assert_int_equal(run("--help"), 0);
    assert_true(contains("out.txt", "breech onset"));
    assert_int_equal(run("--help scene"), 0);
    assert_int_equal(run("scene --help"), 0);
    assert_int_equal(run("--version"), 0);
    assert_true(contains("out.txt", "x86-64") || contains("out.txt", "portable"));
    assert_int_equal(run("--keys"), 0);
    assert_true(contains("out.txt", "cells_per_radius"));
    static const char *const wrong[] = { "",
                                         "fire " SHOT,
                                         "shot",
                                         "shot " SHOT " " SHOT,
                                         "shot " SHOT " --threads 0",
                                         "shot " SHOT " --threads two",
                                         "shot " SHOT " --max-walltime soon",
                                         "shot " SHOT " --max-walltime -1",
                                         "shot " SHOT " --frobnicate",
                                         "shot " SHOT " -o",
                                         "shot " SHOT " --force=yes",
                                         "shot " SHOT " --force --resume -o both",
                                         "compare " SHOT,
                                         "--help fire",
                                         "materials unobtainium",
                                         "report nowhere_at_all",
                                         "shot " SHOT " -o a -o b",
                                         "shot " SHOT " --threads 1 --threads=1",
                                         "shot " SHOT " --store a --no-store",
                                         "shot " SHOT " --max-walltime 1:99",
                                         "check .",
                                         "check loop",
                                         "check pipe" };
    assert_int_equal(system("ln -sf loop loop; [ -p pipe ] || mkfifo pipe"), 0);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        if (run(wrong[i]) != 2) fail_msg("breech %s: not refused with 2", wrong[i]);
        assert_false(contains("err.txt", "Sanitizer"));
    }
    assert_int_equal(run("compare " SHOT), 2);
    assert_true(contains("err.txt", "section `treatments` is missing"));
}

/* A mistyped name is met with the nearest one, and where none is near with where to look; a bad value with the unit and
 * the range of a good one. */
static void test_what_to_try(void **state)
{
    (void)state;
    static const struct {
        const char *words, *says;
    } wrong[] = {
        { "shott x", "breech: no command `shott`; did you mean `shot`? breech --help lists them\n" },
        { "--help chek", "no command `chek`; did you mean `check`?" },
        { "explode x", "breech: no command `explode`; breech --help lists them\n" },
        { "check x --proceses 2", "no option --proceses; did you mean --processes?" },
        { "check --kays", "no option --kays; did you mean --keys?" },
        { "check x --set", "--set needs a value: --set KEY=VALUE\n" },
        { "shot default_sho", "default_sho: there is no such case; did you mean `default_shot`?" },
        { "shot cases/defualt_shot", "there is no such case; did you mean `default_shot`?" },
        { "shot not_here", "not_here: there is no such case; those that came with the program are in " },
        { "shot empty", "empty/case.yaml: there is no such file in this folder\n" },
        { "materials cooper", "breech: material cooper: no material of this name in ." },
        { "flow unobtainium", "`breech materials` lists those at hand\n" },
        { "check " SHOT " --set barrel.length=5", "barrel.length = 5: needs a unit, such as `5 m` (1 mm .. 1 km)\n" },
        { "check " SHOT " --set armature.lead_angle=30", "needs a unit, such as `30 deg` (" },
        { "check " SHOT " --set study.shots=some", "study.shots = some: must be a whole number (1 .. " },
        { "check " SHOT " --set barrel.length=", "barrel.length has no value [m]: breech to muzzle\n" },
        { "check " SHOT " --set 'barrel.length=[1 m, 2 m]'", "must be one value, not a list (1 mm .. 1 km)\n" },
    };
    fresh_folder("empty");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        if (run(wrong[i].words) != 2) fail_msg("breech %s: not refused with 2", wrong[i].words);
        if (!contains("err.txt", wrong[i].says)) fail_msg("breech %s: not `%s`", wrong[i].words, wrong[i].says);
    }
}

/* What was printed into nowhere is no success. */
static void test_full_output(void **state)
{
    (void)state;
    assert_int_equal(system(BREECH_PROGRAM " --keys > /dev/full 2> err.txt") >> 8, 1);
    assert_true(contains("err.txt", "standard output"));
}

/* Every error of the case at once, with its place; nothing is written. */
static void test_bad_case(void **state)
{
    (void)state;
    assert_int_equal(run("check " SHOT " --set ''"), 2);
    assert_true(contains("err.txt", "wanted path.to.key=value"));
    fresh_folder("bad");
    FILE *f = fopen("bad/case.yaml", "w");
    fputs("name: bad\nrails: {height: 25 mm, thickness: 20 kg, separation: 25 mm}\nbarrel: {lenght: 3 m}\n"
          "armature: {mass: -1 kg}\nbank:\n  - {capacitance: 3 mF, charge: 10, inductance: 12 uH}\n",
          f);
    fclose(f);
    assert_int_equal(run("shot bad -o bad_out"), 2);
    assert_true(contains("err.txt", "bad/case.yaml:2:"));
    assert_true(contains("err.txt", "did you mean `length`"));
    assert_true(contains("err.txt", "armature.mass"));
    assert_true(contains("err.txt", "bank[0].charge"));
    assert_false(exists("bad_out"));
    assert_int_equal(run("shot nowhere.yaml -o bad_out"), 2);
    assert_int_equal(run("check bad"), 2);
    assert_int_equal(run("check " SHOT " --set armature.friction_law=film"), 2); /* without wear no film */
    assert_true(contains("err.txt", "armature.wear_fraction"));
    assert_int_equal(run("shot " SHOT " --set bank.charge=9 -o bad_out"), 2);
    assert_false(exists("bad_out"));
}

/* What only the whole tells, said by rooms that know no file: before anything is written, by check as by a run, with
 * its place. */
static void test_places(void **state)
{
    (void)state;
    const struct {
        const char *set, *yaml, *says;
    } wrong[] = {
        { "rail.level=constant", "rail: {level: constant}", "3:15: rail.level constant needs" },
        { "rail.face_crown=90 mm", "rail: {face_crown: 90 mm}", "3:20: rail.face_crown" },
        { "rail.cladding=30 mm", "rail: {cladding: 30 mm}", "3:18: rail.cladding" },
        { "bank[1].position=5 m", "bank: {position: [0 m, 0 m, 5 m], count: 1, fire_at: 0 s}",
          "3:18: bank[2].position" },
        { "optimise.goal=flat", "optimise: {goal: flat}", "3:11: optimise.peak_current is missing" },
        { "rail.layers=[{material: steel_4340, thickness: 12 mm}]",
          "rail: {layers: [{material: steel_4340, thickness: 12 mm}]}", "73:15: scene.rail_depth" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char arguments[600], place[200];
        const char *command = strstr(wrong[i].set, "layers") ? "scene" : "shot";
        fresh_folder("placed");
        FILE *f = fopen("placed/case.yaml", "w");
        fprintf(f, "base: %s\nname: placed\n%s\n", SHOT, wrong[i].yaml);
        fclose(f);
        for (int check = 0; check < 2; check++) {
            snprintf(arguments, sizeof arguments, "%s placed%s", check ? "check" : command,
                     check ? "" : " -o placed/out");
            assert_int_equal(run(arguments), 2);
            snprintf(place, sizeof place, ".yaml:%s", wrong[i].says);
            if (!contains("err.txt", place)) fail_msg("%s: not `%s`", arguments, place);
        }
        assert_false(exists("placed/out"));
        snprintf(arguments, sizeof arguments, "%s " SHOT " --set '%s' -o placed/out", command, wrong[i].set);
        assert_int_equal(run(arguments), 2);
        if (command[1] == 'h' && !contains("err.txt", "--set ")) fail_msg("%s: no place", arguments);
        assert_false(exists("placed/out"));
    }
}

static void test_materials(void **state)
{
    (void)state;
    assert_int_equal(run("materials"), 0);
    assert_true(contains("out.txt", "ofhc_copper") && contains("out.txt", "onset  rail or armature"));
    assert_int_equal(run("materials cucrzr"), 0);
    assert_true(contains("out.txt", "lacks specific_heat"));
    assert_int_equal(run("materials ofhc_copper"), 0);
    assert_true(contains("out.txt", "yield_A"));
    assert_int_equal(run("materials " CASES "/materials/cucrzr.yaml"), 0); /* a file, a folder: nothing else is read */
    assert_true(contains("out.txt", "lacks specific_heat"));
    fresh_folder("metals");
    static const char mine[] = "name: mine\ntitle: mine\nsources: {me: made up}\n"
                               "constants:\n  density: {value: 8000 kg/m^3, source: me}\n";
    OK(host_file_write("metals/mine.yaml", mine, sizeof mine - 1));
    assert_int_equal(run("materials metals"), 0);
    assert_true(contains("out.txt", "mine ") && !contains("out.txt", "ofhc_copper"));
    assert_int_equal(
        system("cd metals && sed 's/^name: .*/name: heavy/; s/^constants:/base: ofhc_copper\\n&/' mine.yaml "
               "> heavy.yaml"),
        0);
    assert_int_equal(run("materials metals"), 0); /* what it builds on is a shipped one */
    assert_true(contains("out.txt", "heavy ") && !contains("out.txt", "has errors"));
    assert_false(contains("out.txt", "cucrzr"));
    assert_int_equal(run("materials metals/other.yaml"), 2);
    assert_true(contains("err.txt", "metals/other.yaml"));
    assert_int_equal(system("sed 's/density/densty/' metals/mine.yaml > metals/wrong.yaml"), 0);
    assert_int_equal(run("materials metals/wrong.yaml"), 2);
    assert_true(contains("err.txt", "densty") && !contains("err.txt", "breech: ")); /* each error once */
    assert_int_equal(system("sed 's/^name: .*/name: beside/' " CASES "/materials/nickel.yaml > beside.yaml"), 0);
    assert_int_equal(run("flow beside"), 0); /* a material of the folder that one works in */
}

/* The set that was named is what the scene says it ran in; a checkpoint of it is no other set's. */
static void test_instruction_set(void **state)
{
    (void)state;
    fresh_folder("set");
    assert_int_equal(
        run("scene " TINY " -o set/a --quiet --no-store --set output.report=no --instruction-set portable"), 0);
    cJSON *a = summary_of("set/a");
    assert_text(a, "instruction_set", "portable");
    cJSON_Delete(a);
    assert_int_equal(run("scene " TINY " -o set/b --quiet --no-store --instruction-set portable --max-walltime 0.01"),
                     75);
    const bool other = strcmp(mpm_instruction_set(), "portable") != 0;
    assert_int_equal(run("scene " TINY " -o set/b --quiet --no-store --resume"), other ? 2 : 0);
    if (other) assert_true(contains("err.txt", "portable"));
}

/* Johnson-Cook by hand: 90 + 292 0.5^0.31 = 325.54 MPa times 1 + 0.025 ln 1000 = 1.17269, isothermal.  0.9 of the work
 * would warm copper by 41.5 K if it did not soften; by 41 K the stress falls by T*^m = 0.0287. */
static void test_flow(void **state)
{
    (void)state;
    assert_int_equal(run("flow ofhc_copper --set strain=0.5 --set points=2 --set 'rate=1000 1/s'"), 0);
    assert_true(contains("out.txt", "Johnson-Cook") && contains("out.txt", "\n0.25 ") &&
                contains("out.txt", "\n0.5 381.758 293\n"));
    assert_int_equal(run("flow ofhc_copper --set strain=0.5 --set points=1 --set 'rate=1000 1/s' --set heat=0.9"), 0);
    assert_true(contains("out.txt", "\n0.5 370.7"));
    assert_int_equal(run("flow water"), 2);
    assert_true(contains("err.txt", "fluid"));
    assert_int_equal(run("flow ofhc_copper --set rate=1000"), 2);
    assert_true(contains("err.txt", "needs a unit"));
    assert_int_equal(run("flow ofhc_copper --set speed=1"), 2);
    assert_true(contains("err.txt", "cold_work"));
    assert_int_equal(run("flow ofhc_copper --set points=1.5"), 2);
    assert_int_equal(run("flow ofhc_copper --set strain=-1"), 2);
    assert_int_equal(run("flow unobtainium"), 2);
}

/* ---- runs ---- */

static void test_shot(void **state)
{
    (void)state;
    fresh_folder("shot");
    assert_int_equal(run("shot " SHOT " -o shot/a --set output.report=no"), 0);
    cJSON *a = summary_of("shot/a");
    assert_text(a, "kind", "shot");
    assert_text(a, "status", "done");
    assert_text(a, "case", "default_shot");
    assert_true(fabs(number(a, "energy_error")) < 1e-6);
    assert_true(exists("shot/a/history.h5") && exists("shot/a/used.yaml"));
    assert_int_equal(run("shot " SHOT " -o shot/a"), 2); /* finished results stay */
    assert_int_equal(run("shot " SHOT " -o shot/a --resume --set output.report=no"), 0);
    assert_int_equal(run("shot " SHOT " -o shot/b --quiet --set output.report=no --set bank.charge='9 kV'"), 0);
    cJSON *b = summary_of("shot/b");
    assert_true(number(b, "muzzle_velocity") < number(a, "muzzle_velocity"));
    assert_int_equal(run("shot shot/a/used.yaml -o shot/c --set output.report=no"),
                     0); /* the same case, the same bits */
    cJSON *c = summary_of("shot/c");
    assert_true(number(c, "muzzle_velocity") == number(a, "muzzle_velocity"));
    cJSON_Delete(a);
    cJSON_Delete(b);
    cJSON_Delete(c);
}

static bool ran_out(const cJSON *s)
{
    const cJSON *flag = cJSON_GetObjectItemCaseSensitive(s, "time_ran_out");
    assert_true(cJSON_IsBool(flag));
    return cJSON_IsTrue(flag);
}

/* A search for firing times that ends far above the peak that was wished says so. */
static void test_missed_peak(void **state)
{
    (void)state;
    fresh_folder("missed");
    assert_int_equal(run("shot " CASES "/flat_current -o missed/out --quiet --threads 1 --set optimise.evaluations=2"),
                     0);
    cJSON *s = summary_of("missed/out");
    assert_true(number(s, "optimise_evaluations") == 2.0 && number(s, "peak_current") > 1e6);
    assert_true(contains("missed/out/summary.json", "optimise.peak_current = 800 kA: with what was found in 2 trials"));
    cJSON_Delete(s);
}

/* Leaving, coming to rest, and max_time while it moves or before it has begun to: told apart. */
static void test_how_a_shot_ends(void **state)
{
    static const struct {
        const char *set, *says;
        bool ran_out;
        double end[2][3]; /* end_time, end_position, end_velocity: at least, at most */
    } way[] = {
        { "options.max_time='100 ms'",
          "leaves the muzzle at 1943 m/s",
          false,
          { { 1e-3, 1.0, 1942.0 }, { 0.1, 9.0, 1944.0 } } },
        { "options.max_time='1 ms'",
          "options.max_time ran out after 1 ms: at x = ",
          true,
          { { 1e-3, 0.01, 10.0 }, { 1e-3, 1.0, 1900.0 } } },
        { "options.max_time='1 us'",
          "options.max_time ran out after 0.001 ms: at x = ",
          true,
          { { 1e-6, 0.0, 0.0 }, { 1e-6, 1.0, 0.1 } } },
        { "bank.charge='1.5 kV'",
          "does not leave the muzzle: rests at x = ",
          false,
          { { 1e-3, 0.0, 0.0 }, { 0.1, 9.0, 0.0 } } },
    };
    static const char *const key[] = { "end_time", "end_position", "end_velocity" };
    (void)state;
    fresh_folder("ends");
    for (int k = 0; k < 4; k++) {
        char command[300];
        snprintf(command, sizeof command, "shot " SHOT " -o ends/a --force --set %s", way[k].set);
        assert_int_equal(run(command), 0);
        if (!contains("out.txt", way[k].says)) fail_msg("%s: the table does not say `%s`", way[k].set, way[k].says);
        assert_int_equal(contains("err.txt", "options.max_time = "), way[k].ran_out); /* the warning */
        assert_int_equal(contains("ends/a/report.html", "when options.max_time runs out"), way[k].ran_out);
        cJSON *s = summary_of("ends/a");
        assert_int_equal(ran_out(s), way[k].ran_out);
        assert_true(isnan(number(s, "muzzle_velocity")) == (k > 0));
        for (int i = 0; i < 3; i++)
            if (!(number(s, key[i]) >= way[k].end[0][i] * (1.0 - 1e-9) &&
                  number(s, key[i]) <= way[k].end[1][i] * (1.0 + 1e-9)))
                fail_msg("%s: %s = %g", way[k].set, key[i], number(s, key[i]));
        cJSON_Delete(s);
    }
}

/* --quiet leaves out what can be done without, not the warnings: the case's own, and what a run finds. */
static void test_quiet_warns(void **state)
{
    char *said = NULL;
    (void)state;
    fresh_folder("quiet");
    assert_int_equal(run("shot " SHOT " -o quiet/a --quiet --set output.report=no --set options.max_time='1 ms'"), 0);
    OK(host_file_read("out.txt", &said, NULL));
    assert_string_equal(said, "");
    free(said);
    assert_true(contains("err.txt", "from secondary or unchecked sources"));
    assert_true(contains("err.txt", "warning: shot: options.max_time = 1 ms ran out"));
}

/* --resume of what another command, case or value left: refused with the difference, and nothing changes. */
static void test_resume_of_another(void **state)
{
    (void)state;
    fresh_folder("other");
    assert_int_equal(run("shot " SHOT " -o other/done --quiet --set output.report=no"), 0);
    const struct {
        const char *arguments, *says;
    } refused[] = {
        { "shot " SHOT " --set output.report=no --set armature.mass='0.2 kg'", "mass: 0.25 kg" },
        { "shot " CASES "/alternator --set output.report=no", "now it would be `name: \"alternator\"`" },
        { "inductance " SHOT " --set output.report=no", "`# Run by: breech shot`" },
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        char arguments[500];
        snprintf(arguments, sizeof arguments, "%s -o other/done --resume", refused[i].arguments);
        assert_int_equal(run(arguments), 2);
        if (!contains("err.txt", refused[i].says)) fail_msg("%s: does not say %s", arguments, refused[i].says);
    }
    assert_int_equal(run("shot " SHOT " -o other/done --resume --set output.report=no"), 0);
    assert_true(contains("out.txt", "finished already"));
    assert_false(exists("other/done/report.html"));

    assert_int_equal(run("scene " TINY " -o other/part --quiet --no-store --max-walltime 0.05"), 75);
    assert_true(contains("err.txt", " --set 'scene.coarse_cell=0.8 mm' --set scene.growth=1.3 "));
    assert_true(contains("err.txt", " --no-store -o other/part --resume\n"));
    assert_int_equal(run("scene " TINY
                         " -o other/three --ensemble 3 --threads 1 --instruction-set portable --store other/st "
                         "--max-walltime 0.05"),
                     75);
    assert_true(contains("err.txt",
                         " --set study.ensemble=3 --threads 1 --instruction-set portable --store other/st -o "
                         "other/three --resume\n"));
    assert_int_equal(run("shot " TINY " -o other/part --resume"), 2);
    assert_true(contains("err.txt", "`# Run by: breech scene`"));
    assert_true(exists("other/part/checkpoint.bin"));
    assert_int_equal(run("scene " TINY " -o other/part --quiet --no-store --resume"), 0);
}

/* Killed while it drew its report, a run is finished; --resume draws it. */
static void test_resume_without_report(void **state)
{
    (void)state;
    fresh_folder("drawn");
    assert_int_equal(run("shot " SHOT " -o drawn --quiet"), 0);
    assert_int_equal(unlink("drawn/report.html"), 0);
    assert_int_equal(run("shot " SHOT " -o drawn --resume"), 0);
    assert_true(contains("out.txt", "finished already"));
    assert_true(exists("drawn/report.html"));
    assert_int_equal(system("rm drawn/report.html && mkdir drawn/report.html"), 0); /* one that cannot be drawn */
    assert_int_equal(run("shot " SHOT " -o drawn --resume"), 1);
    assert_true(contains("err.txt", "no report: "));
    assert_int_equal(run("shot " SHOT " -o drawn --force"), 1);
    assert_true(contains("err.txt", "no report: ") && contains("drawn/summary.json", "\"done\""));
}

/* A site at the very end of the barrel is reached, with the muzzle's velocity. */
static void test_last_site(void **state)
{
    (void)state;
    fresh_folder("last");
    assert_int_equal(run("onset " SHOT " -o last --force --set 'sites=[{position: 3 m}]' --set study.screen_low=1000 "
                         "--set study.sensitivities=no --set output.report=no"),
                     0);
    cJSON *s = summary_of("last");
    const cJSON *site = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(s, "sites"), 0);
    const double muzzle = number(cJSON_GetObjectItemCaseSensitive(s, "shot"), "muzzle_velocity");
    assert_true(fabs(number(site, "velocity") - muzzle) < 1e-6 * muzzle);
    cJSON_Delete(s);
}

static void test_inductance(void **state)
{
    (void)state;
    fresh_folder("inductance");
    assert_int_equal(run("inductance " SHOT " -o inductance/a --set output.report=no"), 0);
    cJSON *s = summary_of("inductance/a");
    const cJSON *L = cJSON_GetObjectItemCaseSensitive(s, "L_gradient"),
                *R = cJSON_GetObjectItemCaseSensitive(s, "R_gradient");
    const int n = cJSON_GetArraySize(L);
    assert_true(n > 5 && n == cJSON_GetArraySize(R));
    for (int i = 1; i < n; i++) { /* skin effect: L' falls, R' rises with the frequency */
        assert_true(cJSON_GetArrayItem(L, i)->valuedouble <= cJSON_GetArrayItem(L, i - 1)->valuedouble);
        assert_true(cJSON_GetArrayItem(R, i)->valuedouble >= cJSON_GetArrayItem(R, i - 1)->valuedouble);
    }
    assert_true(number(s, "L_gradient_high_frequency") < cJSON_GetArrayItem(L, n - 1)->valuedouble);
    assert_true(number(s, "L_gradient_direct_current") >= cJSON_GetArrayItem(L, 0)->valuedouble);
    assert_true(fabs(number(s, "kerrisk_error")) < 0.015); /* the formula's own error for s/h >= 0.5 */
    const int places = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(s, "perimeter"));
    assert_true(places > 10 && places == cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(s, "perimeter_heat")));
    cJSON_Delete(s);
    assert_int_equal(run("report inductance/a"), 0);
    struct stat plot;
    assert_int_equal(stat("inductance/a/plot-inductance.svg", &plot), 0);
    assert_int_equal(stat("inductance/a/plot-perimeter.svg", &plot), 0);
    assert_int_equal(run("inductance " SHOT " -o inductance/b --set rail.cladding=\"30 mm\""),
                     2); /* thicker than the rail */
}

static void test_scene(void **state)
{
    (void)state;
    fresh_folder("scene");
    assert_int_equal(run("scene " TINY " -o scene/a --threads 2 --set output.snapshots=3"), 0);
    assert_int_equal(run("scene " TINY " -o scene/b --threads 1 --set output.snapshots=3"), 0);
    cJSON *a = summary_of("scene/a"), *b = summary_of("scene/b");
    assert_text(a, "kind", "scene");
    assert_text(a, "status", "done");
    assert_same(a, b);                            /* any number of threads gives the same bits */
    assert_true(number(a, "max_pressure") > 1e9); /* 7075 on copper at 1.5 km/s: of the order of the planar 19 GPa */
    assert_true(number(a, "peak_pressure") ==
                fmax(number(a, "peak_pressure_armature_999"), number(a, "peak_pressure_rail_999")));
    assert_true(number(a, "peak_pressure") > 1e8 && number(a, "peak_pressure") < number(a, "max_pressure"));
    assert_true(fabs(number(a, "energy_error")) < 0.01);
    assert_int_equal(files_in("scene/a/scenes/scene", ".hdf"), 3);
    assert_true(exists("scene/a/scenes/scene/scene.hdf.series"));
    assert_false(exists("scene/a/checkpoint.bin"));
    cJSON_Delete(a);
    cJSON_Delete(b);
}

/* The Python package and the ParaView script, on what test_scene left. */
static void test_reader(void **state)
{
    (void)state;
    run_script("read_run.py", BREECH_TESTS "/../python scene/a scene");
}

static void test_paraview_crater(void **state)
{
    (void)state;
    if (!full_tests()) skip();
    if (system("command -v pvbatch xvfb-run > /dev/null") != 0) {
        print_message("paraview or xvfb is not installed\n");
        skip();
    }
    assert_int_equal(system("xvfb-run -a -n $((100 + $$ % 9000)) pvbatch '" BREECH_TESTS
                            "/../coupling/tools/paraview_crater.py' "
                            "scene/a/scenes/scene/scene.hdf.series scene/crater.png damage >out.txt 2>err.txt"),
                     0);
    int points = 0;
    FILE *f = fopen("out.txt", "r");
    assert_non_null(f);
    while (!feof(f) && fscanf(f, "points of the rail: %d", &points) != 1) fgetc(f);
    fclose(f);
    assert_true(points > 1000);
    assert_true(exists("scene/crater.png"));
}

/* A run that fails says so in its summary and with 1. */
static void test_failed(void **state)
{
    (void)state;
    fresh_folder("failed");
    assert_int_equal(run("scene " TINY " -o failed/a --set scene.rail_depth='0.3 mm'"), 2);
    assert_int_equal(run("scene " TINY " -o /proc/nowhere/a"), 1);
    assert_int_equal(system("ulimit -f 4; " BREECH_PROGRAM " shot " SHOT
                            " -o failed/limited --no-store --quiet --threads "
                            "1 --set rail.level=skin >out.txt 2>err.txt; test $? -eq 1"),
                     0);
    assert_true(contains("err.txt", "cannot be written") && files_in("failed/limited", ".part") == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_usage),
        cmocka_unit_test(test_what_to_try),
        cmocka_unit_test(test_full_output),
        cmocka_unit_test(test_bad_case),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_materials),
        cmocka_unit_test(test_flow),
        cmocka_unit_test(test_instruction_set),
        cmocka_unit_test(test_shot),
        cmocka_unit_test(test_how_a_shot_ends),
        cmocka_unit_test(test_missed_peak),
        cmocka_unit_test(test_quiet_warns),
        cmocka_unit_test(test_resume_of_another),
        cmocka_unit_test(test_resume_without_report),
        cmocka_unit_test(test_last_site),
        cmocka_unit_test(test_inductance),
        cmocka_unit_test(test_scene),
        cmocka_unit_test(test_reader),
        cmocka_unit_test(test_paraview_crater),
        cmocka_unit_test(test_failed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
