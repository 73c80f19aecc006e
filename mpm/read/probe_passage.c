/* SPDX-License-Identifier: BSD-3-Clause */
/* Passage: a body on its way through others.  Where the intact metal of its group is and how fast, what stands in its
 * way, and how far the others have given way.
 *
 *            path: within `reach` of the line through `from` along n
 *     ---------------------------+-------+----------
 *       (body) o --> n           | ahead |             ahead: intact metal of the others beyond the body's middle,
 *     ---------------------------+-------+----------          slower along n than half the body's speed
 *
 * What rides on the body's nose, a plug, moves as it does and is not in its way. */
#include "mpm/read/probe_kinds.h"

typedef struct {
    double along[3], from[3], reach, slower;
} passage;

static const base_param params[] = {
    PARAM_VEC3(passage, along, "1", REQUIRED, -1, 1,
               "direction of the way, such as [1, 0, 0]; its length does not count"),
    PROBE_POINT(passage, from, "a point of the line along which the body goes"),
    PARAM_DOUBLE(passage, reach, "m", REQUIRED, 1e-9, PROBE_FARTHEST, "half width of its way, about that line"),
    PARAM_DOUBLE(passage, slower, "m/s", REQUIRED, 1e-9, 1e5,
                 "other bodies' metal that is slower than this stays where it is; what is faster flies"),
    PARAMS_END
};

enum { PLACE, SPEED, AHEAD, REST_SPEED, DEFLECTION, FLYING, INTACT, ROOM, COLUMNS };

static const mpm_column columns[COLUMNS + 1] = {
    { "place", "m", "along the way, of the middle of the intact metal of the body's group" },
    { "speed", "m/s", "along the way, mean of that metal" },
    { "ahead", "kg", "other groups' intact metal in its way: ahead of its middle and slower than half its speed" },
    { "rest_speed", "m/s", "along the way, mean of other groups' metal that is slower than `slower`" },
    { "deflection", "m", "farthest that such metal, intact, has gone along the way since the start" },
    { "flying", "kg", "other groups' metal that is not slower than `slower`" },
    { "intact", "kg", "intact metal of the body's group" },
    { "room", "m", "least way of any of that metal to an end of the window, no mirror, that it moves towards" },
    { NULL, NULL, NULL },
};

/* Sums of one share: first over the body's group, then, with that known, over the others. */
typedef struct {
    const passage *v;
    int group;
    double n[3], place, speed; /* of the body, for the second walk */
    double mass, at, momentum; /* its intact metal: sums of m, m x.n, m v.n */
    double room;               /* of that metal */
    double ahead, rest, rest_momentum, deflection, flying;
} sums;

static double along(const sums *s, const double (*x)[LANES], int l)
{
    return s->n[0] * x[0][l] + s->n[1] * x[1][l] + s->n[2] * x[2][l];
}

/* To the nearest end of the window that is no mirror and that the point moves towards; INFINITY: there is none. */
static double room_of(const mpm_axis ends[3], const block *q, int l)
{
    double room = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double v = q->v[k][l], x = q->x[k][l];
        if (v > 0 && ends[k].boundary[1] != MPM_BOUNDARY_SYMMETRY) room = fmin(room, ends[k].hi - x);
        if (v < 0 && ends[k].boundary[0] != MPM_BOUNDARY_SYMMETRY) room = fmin(room, x - ends[k].lo);
    }
    return room;
}

static void add_own(void *user, const mpm *m, const brick *b, int index)
{
    sums *s = user;
    const block *q = &m->blocks[index];
    if (b->group != s->group) return;
    for (int l = 0; l < LANES; l++) {
        const double M = q->mass[0][l];
        if (!(M > 0) || !(q->damage[0][l] < 1)) continue;
        s->mass += M;
        s->at += M * along(s, q->x, l);
        s->momentum += M * along(s, q->v, l);
        s->room = fmin(s->room, room_of(m->scene.axis, q, l));
    }
}

static bool is_in_the_way(const sums *s, const block *q, int l)
{
    const double ahead = along(s, q->x, l) - s->place;
    double away = 0, beside = 0; /* from the point of the line: squared; along it */
    for (int k = 0; k < 3; k++) {
        const double d = q->x[k][l] - s->v->from[k];
        away += d * d, beside += d * s->n[k];
    }
    return ahead > 0 && away - beside * beside < s->v->reach * s->v->reach && along(s, q->v, l) < 0.5 * s->speed;
}

static void add_other(void *user, const mpm *m, const brick *b, int index)
{
    sums *s = user;
    const block *q = &m->blocks[index];
    if (b->group == s->group) return;
    for (int l = 0; l < LANES; l++) {
        const double M = q->mass[0][l], *slower = &s->v->slower;
        double v2 = 0;
        if (!(M > 0)) continue;
        const bool intact = q->damage[0][l] < 1;
        for (int k = 0; k < 3; k++) v2 += q->v[k][l] * q->v[k][l];
        if (v2 < *slower * *slower) {
            s->rest += M;
            s->rest_momentum += M * along(s, q->v, l);
            if (intact) s->deflection = fmax(s->deflection, along(s, q->x, l) - along(s, q->start, l));
        } else {
            s->flying += M;
        }
        if (intact && is_in_the_way(s, q, l)) s->ahead += M;
    }
}

/* All shares of a walk added up in order. */
static sums walk(const mpm *m, mpm_block_visitor *each, const sums *begin)
{
    sums share[SHARES], all = *begin;
    for (int i = 0; i < SHARES; i++) share[i] = *begin;
    mpm_visit_shares(m, each, share, sizeof *share);
    for (int i = 0; i < SHARES; i++) {
        all.mass += share[i].mass, all.at += share[i].at, all.momentum += share[i].momentum;
        all.ahead += share[i].ahead, all.flying += share[i].flying;
        all.room = fmin(all.room, share[i].room);
        all.rest += share[i].rest, all.rest_momentum += share[i].rest_momentum;
        all.deflection = fmax(all.deflection, share[i].deflection);
    }
    return all;
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    const passage *v = PROBE_VALUES(passage, p);
    const double length = sqrt(v->along[0] * v->along[0] + v->along[1] * v->along[1] + v->along[2] * v->along[2]);
    sums begin = { .v = v, .group = m->scene.body[p->body].group, .deflection = -INFINITY, .room = INFINITY };
    for (int k = 0; k < 3; k++) begin.n[k] = v->along[k] / length;
    const sums own = walk(m, add_own, &begin);
    begin.place = out[PLACE] = own.mass > 0 ? own.at / own.mass : NAN;
    begin.speed = out[SPEED] = own.mass > 0 ? own.momentum / own.mass : NAN;
    const sums others = walk(m, add_other, &begin);
    out[AHEAD] = others.ahead;
    out[REST_SPEED] = others.rest > 0 ? others.rest_momentum / others.rest : NAN;
    out[DEFLECTION] = isfinite(others.deflection) ? others.deflection : NAN;
    out[FLYING] = others.flying;
    out[INTACT] = own.mass;
    out[ROOM] = isfinite(own.room) ? own.room : NAN;
    return status_ok();
}

static status check(const mpm_probe *p, const char *name)
{
    const passage *v = PROBE_VALUES(passage, p);
    CHECK(v->along[0] != 0 || v->along[1] != 0 || v->along[2] != 0, STATUS_BAD_INPUT,
          "%s.along = [0, 0, 0]: must be a direction, such as [1, 0, 0]", name);
    return status_ok();
}

const mpm_probe_kind mpm_probe_passage = { .name = "passage",
                                           .doc = "a body on its way through others: its speed, what stands in its "
                                                  "way, how far they give way",
                                           .params = params,
                                           .columns = columns,
                                           .main = SPEED,
                                           .mains = 1,
                                           .of_body = true,
                                           .check = check,
                                           .read = read };
