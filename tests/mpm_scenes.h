/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes for the tests of the solver, small enough to run in seconds.  Lengths in m.
 *
 * Materials are rows of the reference table, or the same metal made simple: `hydro` without strength, `elastic` with a
 * yield stress out of reach, `dust` with as little stress as the solver takes. */
#ifndef BREECH_TESTS_MPM_SCENES_H
#define BREECH_TESTS_MPM_SCENES_H

#include "base/constants.h"
#include "mpm/law/contact.h"
#include "mpm/mpm.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "full_common.h"
#include "near_common.h"

#define SCENE_PI 3.14159265358979323846 /* a macro: it stands in the value of statics, where PI may not */

#define assert_ok(call)                                                         \
    do {                                                                        \
        const status status_ = (call);                                          \
        if (status_.code != STATUS_OK) fail_msg("%s: %s", #call, status_.text); \
    } while (0)

/* lo .. hi, by rand. */
static inline double scene_random(double lo, double hi)
{
    return lo + (hi - lo) * ((double)rand() / RAND_MAX);
}

/* ---- materials ---- */

static inline mpm_material scene_copper(void) /* row ofhc_copper */
{
    mpm_material m;
    base_params_default(mpm_material_params, &m);
    strcpy(m.name, "ofhc_copper");
    m.density = 8960, m.youngs_modulus = 124e9, m.poisson = 0.34;
    m.specific_heat = 383, m.conductivity = 386;
    m.reference_temperature = 293, m.melting_temperature = 1356;
    m.yield_A = 90e6, m.hardening_B = 292e6, m.hardening_n = 0.31, m.rate_C = 0.025, m.softening_m = 1.09, m.rate_0 = 1;
    m.taylor_quinney = 0.9;
    m.damage_D1 = 0.54, m.damage_D2 = 4.89, m.damage_D3 = -3.03, m.damage_D4 = 0.014, m.damage_D5 = 1.12;
    m.sound_speed = 3940, m.hugoniot_slope = 1.489, m.gruneisen = 2.02;
    return m;
}

static inline mpm_material scene_aluminium(void) /* row w17_al7075 */
{
    mpm_material m;
    base_params_default(mpm_material_params, &m);
    strcpy(m.name, "w17_al7075");
    m.density = 2810, m.youngs_modulus = 71e9, m.poisson = 0.33;
    m.specific_heat = 960;
    m.reference_temperature = 293, m.melting_temperature = 933;
    m.yield_A = 369e6, m.hardening_B = 684e6, m.hardening_n = 0.73, m.rate_C = 0.0083, m.softening_m = 1.7,
    m.rate_0 = 1;
    m.taylor_quinney = 0.9;
    m.damage_D1 = 0.13, m.damage_D2 = 0.13, m.damage_D3 = -1.5, m.damage_D4 = 0.011, m.damage_D5 = 0;
    m.sound_speed = 5350, m.hugoniot_slope = 1.34, m.gruneisen = 2;
    return m;
}

static inline mpm_material scene_hydro(void) /* copper of the plane shocks, without strength */
{
    mpm_material m = scene_copper();
    strcpy(m.name, "hydro");
    m.density = 8930, m.yield_A = 0, m.hardening_B = 0;
    return m;
}

static inline mpm_material scene_elastic(void)
{
    mpm_material m = scene_copper();
    strcpy(m.name, "elastic");
    m.yield_A = 1e10, m.hardening_B = 0, m.rate_C = 0;
    return m;
}

/* us = c0 + s up, and no tension. */
#define WATER_RHO0 1000.0
#define WATER_C0 1480.0
#define WATER_SLOPE 1.92
static inline mpm_material scene_water(void)
{
    mpm_material m;
    base_params_default(mpm_material_params, &m);
    strcpy(m.name, "water");
    m.strength = MPM_STRENGTH_none;
    m.density = WATER_RHO0, m.specific_heat = 4186, m.reference_temperature = 293;
    m.sound_speed = WATER_C0, m.hugoniot_slope = WATER_SLOPE, m.gruneisen = 0.11, m.cavitation_pressure = 0;
    return m;
}

static inline mpm_material scene_dust(void)
{
    mpm_material m = scene_hydro();
    strcpy(m.name, "dust");
    m.sound_speed = 100, m.youngs_modulus = 1e6, m.gruneisen = 0;
    return m;
}

/* ---- parts of a scene ---- */

static inline mpm_axis scene_axis(double lo, double hi, double h, mpm_boundary_kind at_lo, mpm_boundary_kind at_hi)
{
    return (mpm_axis){ .lo = lo,
                       .hi = hi,
                       .fine_lo = lo,
                       .fine_hi = hi,
                       .fine = h,
                       .coarse = h,
                       .growth = 1.2,
                       .boundary = { at_lo, at_hi } };
}

static inline mpm_axis scene_graded(mpm_axis a, double fine_lo, double fine_hi, double coarse, double growth)
{
    a.fine_lo = fine_lo, a.fine_hi = fine_hi, a.coarse = coarse, a.growth = growth;
    return a;
}

/* One more solid, with values in the order of its kind's table; made of those at a and b (-1: none).  Its place. */
static inline int scene_solid(mpm_scene *s, const char *kind, const double *values, int n, int a, int b)
{
    mpm_solid *solid;
    assert_ok(mpm_scene_add_solid(s, kind, a, b, &solid));
    for (int i = 0; i < n; i++) solid->value[i] = values[i];
    return s->solids - 1;
}

/* Values of the root of a body's solids. */
static inline double *scene_values(mpm_scene *s, int body)
{
    return s->solid[s->body[body].solid].value;
}

/* Valid until the next body is added. */
static inline mpm_body *scene_body(mpm_scene *s, const char *shape, const double *values, int n, const mpm_material *m)
{
    const int solid = scene_solid(s, shape, values, n, -1, -1);
    mpm_body *b;
    assert_ok(mpm_scene_add_body(s, &b));
    snprintf(b->name, sizeof b->name, "body%d", s->bodies - 1);
    b->material = m;
    b->solid = solid;
    return b;
}

static inline mpm_body *scene_box(mpm_scene *s, double x0, double y0, double z0, double x1, double y1, double z1,
                                  const mpm_material *m)
{
    const double v[] = { x0, y0, z0, x1, y1, z1 };
    return scene_body(s, "box", v, 6, m);
}

/* Of all groups without a pair of their own. */
static inline void scene_friction(mpm_scene *s, double mu)
{
    s->contact.value[COULOMB_FRICTION] = mu;
}

/* How two groups touch, to be changed. */
static inline double *scene_pair(mpm_scene *s, int a, int b)
{
    mpm_pair *p;
    assert_ok(mpm_scene_add_pair(s, a, b, &p));
    return p->contact.value;
}

/* The boundaries at these ends of axis k do not act on the body. */
static inline void scene_pass(mpm_body *b, int k, bool lo, bool hi)
{
    b->passes[2 * k] = lo, b->passes[2 * k + 1] = hi;
}

/* Freed where its block ends. */
#define SCENE_LOCAL(s) __attribute__((cleanup(mpm_scene_free))) mpm_scene s = { 0 }

/* A bar along x, `cells` of size h across, mirrors on its four sides: one-dimensional. */
static inline void scene_bar(mpm_scene *s, double x0, double x1, double h, int cells)
{
    mpm_scene_free(s); /* of one that a test uses again */
    mpm_scene_default(s);
    s->axis[0] = scene_axis(x0, x1, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s->axis[1] = scene_axis(0, cells * h, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    s->axis[2] = s->axis[1];
}

/* Half a U along x on the plane y = 0 (a leg, a head before it), lead face in front: a prism along z about z = 0. */
typedef struct {
    double front, length, leg, head, top, chamfer, lead, half_width;
} scene_u;

static inline mpm_body *scene_slider(mpm_scene *s, const scene_u *u, const mpm_material *m)
{
    const double nose = u->front + u->chamfer / tan(u->lead), back = nose - u->length, inner = nose - u->head;
    const double v[] = { -u->half_width,
                         u->half_width,
                         0,
                         0,
                         1, /* along z */
                         back,
                         0,
                         u->front,
                         0,
                         nose,
                         u->chamfer,
                         nose,
                         u->top,
                         inner,
                         u->top,
                         inner,
                         u->leg,
                         back,
                         u->leg };
    return scene_body(s, "prism", v, sizeof v / sizeof v[0], m);
}

/* A small gouge: a rail, a hemispherical grain welded to it, and a slab with a lead face that runs over it. */
typedef struct {
    mpm_material copper, aluminium;
    mpm_scene scene;
} gouge_scene;

static inline void scene_gouge_free(gouge_scene *g)
{
    mpm_scene_free(&g->scene);
}

#define GOUGE_LOCAL(g) __attribute__((cleanup(scene_gouge_free))) gouge_scene g = { .scene = { 0 } }

static inline void scene_gouge(gouge_scene *g, double h, double speed)
{
    g->copper = scene_copper(), g->aluminium = scene_aluminium();
    mpm_scene *s = &g->scene;
    mpm_scene_free(s); /* of one that a test uses again */
    mpm_scene_default(s);
    s->axis[0] = scene_axis(-8e-3, 8e-3, h, MPM_BOUNDARY_ABSORBING, MPM_BOUNDARY_ABSORBING);
    s->axis[0] = scene_graded(s->axis[0], -1e-3, 4e-3, 3 * h, 1.25);
    s->axis[1] = scene_axis(-2e-3, 2.5e-3, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    s->axis[1] = scene_graded(s->axis[1], -0.8e-3, 0.8e-3, 3 * h, 1.25);
    s->axis[2] = scene_axis(0, 2.5e-3, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE);
    s->axis[2] = scene_graded(s->axis[2], 0, 1e-3, 3 * h, 1.25);
    scene_box(s, -8e-3, -2e-3, -1, 8e-3, 0, 1, &g->copper);
    const double grain[] = { 0, 0, 0, 0.5e-3, 0.5e-3 };
    scene_body(s, "hemisphere", grain, 5, &g->copper);
    const scene_u u = { -1e-3, 6e-3, 1.5e-3, 2e-3, 2.5e-3, 1e-3, SCENE_PI / 6, 2e-3 };
    mpm_body *armature = scene_slider(s, &u, &g->aluminium);
    armature->group = 1;
    armature->velocity[0] = speed;
    scene_pass(armature, 0, true, true);
    for (int i = 0; i < 3; i++) s->body[i].damage = true;
    scene_friction(s, 0.2);
}

/* ---- running and reading ---- */

static inline mpm *scene_make(const mpm_scene *s, int threads)
{
    mpm *m = NULL;
    assert_ok(mpm_create(s, threads, &m));
    return m;
}

static inline void scene_steps(mpm *m, int steps)
{
    for (int i = 0; i < steps; i++) {
        const mpm_report r = mpm_state(m);
        assert_ok(mpm_advance(m, r.time + r.dt, NULL));
    }
}

static inline double *scene_read(const mpm *m, mpm_field field) /* the caller frees it */
{
    double *out = malloc((mpm_points(m) * (size_t)mpm_field_table[field].width + 1) * sizeof *out);
    assert_non_null(out);
    mpm_read(m, field, out);
    return out;
}

static inline double scene_largest(const mpm *m, mpm_field field) /* largest magnitude of any component */
{
    double *a = scene_read(m, field), largest = 0;
    const size_t n = mpm_points(m) * (size_t)mpm_field_table[field].width;
    for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(a[i]));
    free(a);
    return largest;
}

static inline double scene_mean(const mpm *m, mpm_field field, int component, int body) /* by mass; body -1: all */
{
    double *a = scene_read(m, field), *mass = scene_read(m, MPM_mass), *of = scene_read(m, MPM_body), sum = 0,
           total = 0;
    const size_t width = (size_t)mpm_field_table[field].width;
    for (size_t i = 0; i < mpm_points(m); i++)
        if (body < 0 || of[i] == body) sum += mass[i] * a[width * i + (size_t)component], total += mass[i];
    free(a), free(mass), free(of);
    return sum / total;
}

/* ---- bits ---- */

/* Every readable field of every particle, then the books, and those of bodies and groups. */
typedef struct {
    size_t bytes;
    char *data;
} scene_picture;

static inline char *scene_put(char *to, const void *from, size_t bytes)
{
    if (bytes) memcpy(to, from, bytes);
    return to + bytes;
}

static inline scene_picture scene_picture_of(const mpm *m)
{
    const mpm_ledger l = mpm_balance(m);
    const mpm_report r = mpm_state(m);
    const mpm_scene *s = mpm_scene_of(m);
    const size_t bodies = (size_t)s->bodies, groups = (size_t)mpm_scene_groups(s);
    size_t doubles = bodies + 6 * groups;
    for (int f = 0; f < MPM_FIELD_COUNT; f++) doubles += mpm_points(m) * (size_t)mpm_field_table[f].width;
    scene_picture p = { doubles * sizeof(double) + sizeof l + sizeof r + bodies * sizeof(mpm_body_report), NULL };
    p.data = malloc(p.bytes);
    assert_non_null(p.data);
    double *to = (double *)(void *)p.data;
    for (int f = 0; f < MPM_FIELD_COUNT; f++) {
        mpm_read(m, (mpm_field)f, to);
        to += mpm_points(m) * (size_t)mpm_field_table[f].width;
    }
    mpm_failed_volumes(m, to);
    char *at = scene_put(scene_put((char *)(to + bodies), &l, sizeof l), &r, sizeof r);
    for (int i = 0; i < s->bodies; i++) {
        const mpm_body_report b = mpm_body_state(m, i);
        at = scene_put(at, &b, sizeof b);
    }
    for (int g = 0; g < (int)groups; g++) {
        at = scene_put(at, mpm_contact_force(m, g), 3 * sizeof(double));
        at = scene_put(at, mpm_peak_contact_force(m, g), 3 * sizeof(double));
    }
    return p;
}

static inline void scene_assert_same(scene_picture a, scene_picture b, const char *what)
{
    if (a.bytes != b.bytes) fail_msg("%s: %zu bytes, want %zu", what, b.bytes, a.bytes);
    for (size_t i = 0; i < a.bytes; i += sizeof(double))
        if (memcmp(a.data + i, b.data + i, sizeof(double)) != 0)
            fail_msg("%s: differs at byte %zu of %zu", what, i, a.bytes);
}

/* A run on one thread, the same on two, and one on three that goes on from the first's image: `before` steps, image,
 * `after` steps, the same bits.  Returns the first, which the caller frees. */
static inline mpm *scene_same_bits(const mpm_scene *s, int before, int after)
{
    void *image = NULL;
    size_t bytes = 0;
    mpm *m[3];
    scene_picture p[3];
    for (int i = 0; i < 3; i++) {
        m[i] = scene_make(s, 1 + i);
        if (i == 2) assert_ok(mpm_restore(m[i], image, bytes));
        if (i < 2) scene_steps(m[i], before);
        if (i == 0) assert_ok(mpm_save(m[i], &image, &bytes));
        scene_steps(m[i], after);
        p[i] = scene_picture_of(m[i]);
    }
    scene_assert_same(p[0], p[1], "two threads");
    scene_assert_same(p[0], p[2], "three threads from an image");
    for (int i = 0; i < 3; i++) free(p[i].data);
    mpm_free(m[1]), mpm_free(m[2]);
    free(image);
    return m[0];
}

#endif
