/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/metal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- reading ---- */

enum { COLUMNS = 12 }; /* doubles a point */

static status points_read(const mpm *m, gouge_points *p)
{
    const size_t n = mpm_points(m), room = n ? n : 1;
    double *all = malloc(room * COLUMNS * sizeof *all);
    CHECK(all, STATUS_MEMORY, "no memory to read %zu material points", n);
    *p = (gouge_points){ .n = n,
                         .position = all,
                         .velocity = all + 3 * room,
                         .size = all + 6 * room,
                         .damage = all + 9 * room,
                         .mass = all + 10 * room,
                         .body = all + 11 * room };
    mpm_read(m, MPM_position, p->position);
    mpm_read(m, MPM_velocity, p->velocity);
    mpm_read(m, MPM_size, p->size);
    mpm_read(m, MPM_damage, p->damage);
    mpm_read(m, MPM_mass, p->mass);
    mpm_read(m, MPM_body, p->body);
    return status_ok();
}

void gouge_points_free(gouge_points *p)
{
    free(p->position);
    *p = (gouge_points){ .n = 0 };
}

static bool over_map(const crater_spec *s, const double x[3], const double half[3])
{
    return x[0] + half[0] >= s->x_lo && x[0] - half[0] <= s->x_hi && fabs(x[2]) - half[2] <= s->z_hi;
}

status gouge_points_of_rail(const gouge_scene *s, const crater_spec *map, const mpm *m, gouge_points *p)
{
    size_t kept = 0;
    TRY(points_read(m, p));
    for (size_t i = 0; i < p->n; i++) {
        double *x = p->position + 3 * i, *half = p->size + 3 * i;
        if (!gouge_counts_as_rail(s, (int)p->body[i]) || !over_map(map, x, half)) continue;
        memmove(p->position + 3 * kept, x, 3 * sizeof *x);
        memmove(p->velocity + 3 * kept, p->velocity + 3 * i, 3 * sizeof *x);
        memmove(p->size + 3 * kept, half, 3 * sizeof *x);
        p->damage[kept] = p->damage[i];
        p->mass[kept] = p->mass[i];
        kept++;
    }
    p->n = kept;
    return status_ok();
}

/* ---- what goes with the armature ---- */

status gouge_armature_metal(const gouge_scene *s, const mpm *m, gouge_metal *out)
{
    const double slow = 0.5 * s->velocity;
    gouge_points p;
    *out = (gouge_metal){ 0.0, 0.0 };
    TRY(points_read(m, &p));
    for (size_t i = 0; i < p.n; i++) {
        const double vx = p.velocity[3 * i];
        if ((int)p.body[i] != s->armature || !(p.damage[i] < 1.0) || vx < slow) continue;
        out->mass += p.mass[i];
        out->momentum += p.mass[i] * vx;
    }
    gouge_points_free(&p);
    return status_ok();
}

status gouge_carried_volumes(const gouge_scene *s, const mpm *m, double *volume)
{
    const double fast = 0.5 * s->velocity, halves = s->crater.mirrored ? 2.0 : 1.0;
    gouge_points p;
    TRY(points_read(m, &p));
    for (int b = 0; b < s->scene.bodies; b++) volume[b] = 0.0;
    for (size_t i = 0; i < p.n; i++) {
        const int body = (int)p.body[i];
        if (p.damage[i] < 1.0 && p.velocity[3 * i] > fast)
            volume[body] += halves * p.mass[i] / s->scene.body[body].material->density;
    }
    gouge_points_free(&p);
    return status_ok();
}
