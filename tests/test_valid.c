/* SPDX-License-Identifier: BSD-3-Clause */
/* The validations of tests/validate held to their limits: the coarse levels, all of them with BREECH_FULL=1.  Momentum
 * and mass everywhere. */
#include "valid.h"

static const double ROUNDING = 1e-12; /* of sums over all points */

static void hold(const valid_case *c, const valid_result *r, const double *limit)
{
    for (int i = 0; i < VALID_FIGURES && c->figure[i]; i++)
        if (!(fabs(r->figure[i]) <= limit[i]))
            fail_msg("%s, %s: %.4g, limit %.4g", c->name, c->figure[i], r->figure[i], limit[i]);
}

static void run_case(const valid_case *c)
{
    valid_result r;
    double first = 0;
    int last = -1;
    for (int i = 0; i < VALID_LEVELS && c->cells[i] > 0 && (full_tests() || i < c->quick); i++) {
        memset(&r, 0, sizeof r);
        c->run(c->cells[i], &valid_default, &r);
        print_message("%s %s, %g cells of the %s: %s %.3e, energy %.1e, momentum %.1e\n", c->name, c->doc, c->cells[i],
                      c->per, c->figure[0], r.figure[0], r.energy, r.momentum);
        assert_below(r.momentum, ROUNDING);
        assert_below(fabs(r.mass), ROUNDING * 10); /* of sums over as many points */
        if (i == 0) first = r.figure[0];
        if (i == c->quick - 1) hold(c, &r, c->limit_quick);
        last = i;
    }
    assert_true(last >= 0);
    if (full_tests()) hold(c, &r, c->limit_full);
    if (last > 0 && c->order > 0) assert_true(log(first / r.figure[0]) / log(c->cells[last] / c->cells[0]) >= c->order);
}

/* The table decides what is tested: a validation without a limit on its error is none. */
static void test_table(void **state)
{
    (void)state;
    for (int i = 0; i < valid_cases; i++) {
        assert_true(isfinite(valid_table[i].limit_quick[0]));
        assert_true(valid_table[i].quick >= 1 && valid_table[i].cells[valid_table[i].quick - 1] > 0);
        for (int j = 0; j < i; j++) assert_string_not_equal(valid_table[i].name, valid_table[j].name);
    }
}

static void test_all(void **state)
{
    (void)state;
    for (int i = 0; i < valid_cases; i++) run_case(&valid_table[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_table), cmocka_unit_test(test_all) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
