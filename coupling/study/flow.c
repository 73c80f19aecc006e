/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/flow.h"

#include "coupling/host/units.h"

#include <stdlib.h>
#include <string.h>

static const base_param *key_find(const char *set, size_t length)
{
    for (const base_param *p = mpm_flow_test_params; p->key; p++)
        if (strlen(p->key) == length && strncmp(p->key, set, length) == 0) return p;
    return NULL;
}

static void keys_text(char *out, size_t size)
{
    size_t used = 0;
    for (const base_param *p = mpm_flow_test_params; p->key && used < size; p++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", p == mpm_flow_test_params ? "" : ", ", p->key);
}

static status take(const units *u, const char *set, mpm_flow_test *test)
{
    const char *equals = strchr(set, '=');
    char keys[200], unit[UNIT_SIZE];
    keys_text(keys, sizeof keys);
    const base_param *p = equals ? key_find(set, (size_t)(equals - set)) : NULL;
    CHECK(p, STATUS_BAD_INPUT, "--set %.60s: must be KEY=VALUE with a key of %s", set, keys);
    double value;
    char limits[LIMITS_SIZE];
    const status s = host_quantity_read(u, equals + 1, p->unit, &value, unit);
    host_quantity_limits(u, p->min, p->max, p->unit, "", limits);
    CHECK(s.code == STATUS_OK, STATUS_BAD_INPUT, "--set %.60s: %s (%s)", set, s.text, limits);
    void *member = (char *)test + p->offset;
    if (p->kind == BASE_PARAM_INTEGER) {
        CHECK(value == floor(value) && fabs(value) < 1e9, STATUS_BAD_INPUT, "--set %.60s: must be a whole number (%s)",
              set, limits);
        *(int *)member = (int)value;
    } else {
        *(double *)member = value;
    }
    return status_ok();
}

static status take_all(const char *const *sets, int n, mpm_flow_test *test)
{
    units *u;
    status s = host_units_open(&u);
    for (int i = 0; i < n && s.code == STATUS_OK; i++) s = take(u, sets[i], test);
    host_units_close(u);
    return s;
}

status study_flow_print(const mpm_material *m, const char *const *sets, int n, FILE *out)
{
    mpm_flow_test test;
    base_params_default(mpm_flow_test_params, &test);
    TRY(take_all(sets, n, &test));
    TRY(base_params_check(mpm_flow_test_params, &test, "flow"));
    mpm_flow_point *curve = malloc(((size_t)test.points + 1) * sizeof *curve);
    CHECK(curve, STATUS_MEMORY, "no memory for %d points", test.points);
    const status s = mpm_flow_curve(m, &test, curve);
    if (s.code == STATUS_OK) {
        fprintf(out, "# %s: %s\n# strain  flow stress [MPa]  temperature [K]\n", m->name,
                mpm_material_strength_text(m->strength));
        for (int i = 0; i <= test.points; i++)
            fprintf(out, "%.6g %.6g %.6g\n", curve[i].strain, 1e-6 * curve[i].stress, curve[i].temperature);
    }
    free(curve);
    return s;
}
