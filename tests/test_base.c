/* SPDX-License-Identifier: BSD-3-Clause */
/* base/: constants, status and parameter tables.  Tolerances of the latter two are zero: there nothing is computed,
 * only copied. */
#include "base/constants.h"
#include "base/param.h"
#include "base/status.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* ---- constants, by the numbers they follow from ---- */

/* mu_0 = 2 alpha h/(c e^2), known to ten digits; R = N_A k, exact. */
static void test_constants(void **state)
{
    (void)state;
    const double alpha = 7.2973525693e-3, h = 6.62607015e-34, e = 1.602176634e-19, c = 299792458.0;
    assert_true(PI == acos(-1.0));
    assert_true(fabs(MU0 * c * e * e / (2.0 * alpha * h) - 1.0) < 1e-10);
    assert_true(fabs(GAS_CONSTANT / (6.02214076e23 * 1.380649e-23) - 1.0) < 1e-14);
}

/* ---- status ---- */

static status refuse_negative(double x)
{
    CHECK(x >= 0, STATUS_BAD_INPUT, "x = %g m: must not be negative", x);
    return status_ok();
}

static status pass_on(double x, bool *reached_end)
{
    TRY(refuse_negative(x));
    *reached_end = true;
    return status_ok();
}

static void test_status_ok(void **state)
{
    (void)state;
    const status s = status_ok();
    assert_int_equal(s.code, STATUS_OK);
    assert_string_equal(s.text, "");
}

static void test_status_text_is_formatted(void **state)
{
    (void)state;
    const status s = base_status_error(STATUS_IO, "%s: line %d, %.1f V", "file", 12, 2.5);
    assert_int_equal(s.code, STATUS_IO);
    assert_string_equal(s.text, "file: line 12, 2.5 V");
}

static void test_status_long_text_is_cut(void **state)
{
    (void)state;
    char text[2000];
    memset(text, 'a', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    const status s = base_status_error(STATUS_MEMORY, "%s", text);
    assert_int_equal(strlen(s.text), sizeof s.text - 1);
}

static void test_check_and_try(void **state)
{
    (void)state;
    bool reached_end = false;
    status s = pass_on(-1.5, &reached_end);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_string_equal(s.text, "x = -1.5 m: must not be negative");
    assert_false(reached_end);
    s = pass_on(0.0, &reached_end);
    assert_int_equal(s.code, STATUS_OK);
    assert_true(reached_end);
}

/* ---- parameters ---- */

typedef struct {
    char name[BASE_PARAM_TEXT_SIZE], note[BASE_PARAM_TEXT_SIZE];
    double capacitance, limit, gap;
    int count, level;
    bool muzzle;
    double axis[3];
} part;

static const char *const levels[] = { "constant", "skin", NULL };

static const base_param part_params[] = {
    PARAM_STRING(part, name, NULL, "name of the part"),
    PARAM_STRING(part, note, "none", "a remark"),
    PARAM_DOUBLE(part, capacitance, "F", REQUIRED, 1e-12, 1e3, "capacitance of the part"),
    PARAM_DOUBLE(part, limit, "V", OPTIONAL, 0, 10, "highest voltage"),
    PARAM_DOUBLE(part, gap, "m", 0.25, 0, 1, "gap of the part"),
    PARAM_INT(part, count, 3, 1, 40, "number of parts"),
    PARAM_ENUM(part, level, levels, 1, "model of the rails"),
    PARAM_BOOL(part, muzzle, true, "whether it has a muzzle"),
    PARAM_VEC3(part, axis, "m", 0.5, -1, 1, "axis of the part"),
    PARAMS_END,
};

/* Every byte set before, so that a member that base_params_default leaves alone shows. */
static part part_with_defaults(void)
{
    part p;
    memset(&p, 0x5a, sizeof p);
    base_params_default(part_params, &p);
    return p;
}

static part part_valid(void)
{
    part p = part_with_defaults();
    strcpy(p.name, "coil");
    p.capacitance = 1e-3;
    return p;
}

static void assert_refused(const part *p, const char *text)
{
    const status s = base_params_check(part_params, p, "bank");
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_string_equal(s.text, text);
}

static void assert_accepted(const part *p)
{
    const status s = base_params_check(part_params, p, "bank");
    assert_string_equal(s.text, "");
    assert_int_equal(s.code, STATUS_OK);
}

static void test_default_of_every_kind(void **state)
{
    (void)state;
    const part p = part_with_defaults();
    assert_string_equal(p.name, "");
    assert_string_equal(p.note, "none");
    assert_true(isnan(p.capacitance)); /* required: unset, not infinite */
    assert_true(isnan(p.limit));
    assert_true(p.gap == 0.25);
    assert_int_equal(p.count, 3);
    assert_int_equal(p.level, 1);
    assert_true(p.muzzle);
    for (int k = 0; k < 3; k++) assert_true(p.axis[k] == 0.5);
}

static void test_default_text_is_cut_and_ended(void **state)
{
    (void)state;
    static const char longer[] = "0123456789012345678901234567890123456789012345678901234567890123456789";
    const base_param table[] = { PARAM_STRING(part, name, longer, "too long"), PARAMS_END };
    part p;
    memset(&p, 0x5a, sizeof p);
    base_params_default(table, &p);
    assert_int_equal(strlen(p.name), BASE_PARAM_TEXT_SIZE - 1);
    assert_memory_equal(p.name, longer, BASE_PARAM_TEXT_SIZE - 1);
    assert_int_equal(p.note[0], 0x5a); /* the neighbour is untouched */
}

static void test_check_accepts_defaults_once_required_are_set(void **state)
{
    (void)state;
    const part p = part_valid();
    assert_accepted(&p);
}

static void test_check_names_what_is_required(void **state)
{
    (void)state;
    part p = part_valid();
    p.capacitance = NAN;
    assert_refused(&p, "bank.capacitance is required [F]: capacitance of the part");
    p = part_valid();
    p.name[0] = '\0';
    assert_refused(&p, "bank.name is required: name of the part");
}

static void test_check_range_is_inclusive(void **state)
{
    (void)state;
    part p = part_valid();
    p.gap = 0;
    assert_accepted(&p);
    p.gap = 1;
    assert_accepted(&p);
    p.gap = nextafter(0, -1);
    assert_int_equal(base_params_check(part_params, &p, "bank").code, STATUS_BAD_INPUT);
    p.gap = nextafter(1, 2);
    assert_int_equal(base_params_check(part_params, &p, "bank").code, STATUS_BAD_INPUT);
    p.gap = INFINITY;
    assert_int_equal(base_params_check(part_params, &p, "bank").code, STATUS_BAD_INPUT);
    p.gap = -2;
    assert_refused(&p, "bank.gap = -2 m: must be 0 .. 1 m");
}

static void test_check_optional_may_stay_unset(void **state)
{
    (void)state;
    part p = part_valid();
    assert_true(isnan(p.limit));
    assert_accepted(&p);
    p.limit = 11;
    assert_refused(&p, "bank.limit = 11 V: must be 0 .. 10 V");
}

static void test_check_integers_and_vectors(void **state)
{
    (void)state;
    part p = part_valid();
    p.count = 0;
    assert_refused(&p, "bank.count = 0: must be 1 .. 40");
    p = part_valid();
    p.count = 41;
    assert_int_equal(base_params_check(part_params, &p, "bank").code, STATUS_BAD_INPUT);
    for (int k = 0; k < 3; k++) {
        p = part_valid();
        p.axis[k] = 1.5;
        assert_refused(&p, "bank.axis = 1.5 m: must be -1 .. 1 m");
    }
}

static void test_check_choice_lies_in_its_list(void **state)
{
    (void)state;
    part p = part_valid();
    p.level = 0;
    assert_accepted(&p);
    p.level = 2;
    assert_refused(&p, "bank.level = choice 2: must be one of the 2 from constant to skin");
    p.level = -1;
    assert_int_equal(base_params_check(part_params, &p, "bank").code, STATUS_BAD_INPUT);
}

static void test_check_refuses_nan_where_a_default_exists(void **state)
{
    (void)state;
    part p = part_valid();
    p.gap = NAN;
    assert_int_equal(base_params_check(part_params, &p, "bank").code, STATUS_BAD_INPUT);
}

static void test_check_reports_the_first_in_table_order(void **state)
{
    (void)state;
    part p = part_valid();
    p.count = 0;
    p.gap = 2;
    assert_refused(&p, "bank.gap = 2 m: must be 0 .. 1 m");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_constants),
        cmocka_unit_test(test_status_ok),
        cmocka_unit_test(test_status_text_is_formatted),
        cmocka_unit_test(test_status_long_text_is_cut),
        cmocka_unit_test(test_check_and_try),
        cmocka_unit_test(test_default_of_every_kind),
        cmocka_unit_test(test_default_text_is_cut_and_ended),
        cmocka_unit_test(test_check_accepts_defaults_once_required_are_set),
        cmocka_unit_test(test_check_names_what_is_required),
        cmocka_unit_test(test_check_range_is_inclusive),
        cmocka_unit_test(test_check_optional_may_stay_unset),
        cmocka_unit_test(test_check_integers_and_vectors),
        cmocka_unit_test(test_check_choice_lies_in_its_list),
        cmocka_unit_test(test_check_refuses_nan_where_a_default_exists),
        cmocka_unit_test(test_check_reports_the_first_in_table_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
