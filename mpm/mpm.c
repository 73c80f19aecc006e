/* SPDX-License-Identifier: BSD-3-Clause */
/* The solver's step and its ledger. */
#include "mpm/grid/face_depth.h"
#include "mpm/law/contact.h"
#include "mpm/memory/build.h"
#include "mpm/memory/cavities.h"
#include "mpm/memory/runs.h"
#include "mpm/memory/store.h"
#include "mpm/refine/refine.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

static const int SCATTERED = 8;       /* the blocks' order in memory is restored when one of so many is out of it */
static const int SAMPLE_EVERY = 20;   /* steps of the finest level between percentile samples */
static const int RELAX_EVERY = 16;    /* the same between relaxations of pressure */
enum { START_BLOCKS = 1 << 15 };      /* room at the start: memory that nobody touches costs nothing, growing does */
static const double DT_GROWTH = 1.05; /* a step of the coarsest level */
static const double DT_LEAST = 1.0 / 300;     /* of the first step: no shock up to 10 km/s needs less */
static const double FORCE_SMOOTHING = 0.2e-6; /* [s] */

/* ---- making ---- */

static void particle_make(double *q, const build_point *p, const law *k, double temperature)
{
    for (int i = 0; i < 3; i++) {
        q[FIRST_x + i] = q[FIRST_start + i] = p->x[i];
        q[FIRST_v + i] = p->v[i];
        q[FIRST_half + i] = p->half[i];
    }
    memcpy(q + FIRST_L, p->L, sizeof p->L);
    q[FIRST_ka] = p->ka;
    q[FIRST_rho] = k->rho_start;
    q[FIRST_e] = k->e_start;
    q[FIRST_p] = k->p_start;
    q[FIRST_flow] = k->flow_start;
    q[FIRST_T] = temperature;
    q[FIRST_mass] = p->mass;
    q[FIRST_area] = p->area;
}

/* What the solver makes of a point: q has BLOCK_DOUBLES. */
static void point_of(const mpm *m, int body, const build_point *p, double *q)
{
    memset(q, 0, BLOCK_DOUBLES * sizeof *q);
    particle_make(q, p, &m->laws[body], m->scene.body[body].temperature);
}

static status insert_point(void *user, int body, const build_point *p)
{
    double q[BLOCK_DOUBLES];
    point_of(user, body, p, q);
    return mpm_store_place(user, body, q);
}

static status make_laws(mpm *m)
{
    mpm_scene *s = &m->scene;
    m->materials = malloc((size_t)s->bodies * sizeof *m->materials);
    m->laws = aligned_alloc(64, ((size_t)s->bodies * sizeof *m->laws + 63) / 64 * 64);
    m->effusivity = malloc((size_t)s->bodies * sizeof *m->effusivity);
    m->waves = calloc((size_t)s->bodies, sizeof *m->waves);
    m->load = calloc((size_t)s->bodies * MPM_MAX_LEVELS, sizeof *m->load);
    m->body_report = calloc((size_t)s->bodies, sizeof *m->body_report);
    m->peaks_row = ((size_t)s->bodies + 15) / 8 * 8; /* a line of the cache lies between two threads' */
    m->peaks = calloc(MPM_MAX_THREADS * m->peaks_row, sizeof *m->peaks);
    CHECK(m->materials && m->laws && m->effusivity && m->waves && m->load && m->body_report && m->peaks, STATUS_MEMORY,
          "no memory for %d bodies", s->bodies);
    for (int i = 0; i < s->bodies; i++) {
        m->materials[i] = *s->body[i].material;
        s->body[i].material = &m->materials[i];
        TRY(mpm_law_make(&s->body[i], s, &m->laws[i]));
        TRY(mpm_wave_make(&s->body[i], &m->laws[i], &m->waves[i]));
        const mpm_material *k = &m->materials[i];
        m->effusivity[i] = sqrt(k->conductivity * k->density * k->specific_heat);
    }
    return status_ok();
}

/* Would a node of one of them have another share of contact heat, or another absorbing wall, than one of the other? */
static bool unlike(const mpm *m, int a, int b)
{
    const law *k = &m->laws[a], *l = &m->laws[b];
    const double e[2] = { m->effusivity[a], m->effusivity[b] };
    return !(e[0] == e[1] || (isnan(e[0]) && isnan(e[1]))) || k->K0 != l->K0 || k->G != l->G || k->rho0 != l->rho0 ||
           k->p_start / k->rho_start != l->p_start / l->rho_start;
}

static touch_rule rule_from(const mpm_pair *p)
{
    touch_rule r = { .law = mpm_contact_index(p->contact.law),
                     .normal_of_higher = p->normal_of > p->a || p->normal_of > p->b };
    memcpy(r.value, p->contact.value, sizeof r.value);
    return r;
}

static status make_groups(mpm *m)
{
    const mpm_scene *s = &m->scene;
    const size_t n = (size_t)(m->groups = mpm_scene_groups(s));
    m->group = calloc(n, sizeof *m->group);
    m->rule = malloc(((size_t)s->pairs + 1) * sizeof *m->rule);
    m->rule_of = calloc(n * n, sizeof *m->rule_of);
    m->contact = calloc((1 + SHARES) * n, sizeof *m->contact);
    m->force = calloc(n, sizeof *m->force);
    m->depths = n > 1 ? malloc(sizeof *m->depths) : NULL;
    CHECK(m->group && m->rule && m->rule_of && m->contact && m->force && (m->depths || n < 2), STATUS_MEMORY,
          "no memory for %zu groups", n);
    if (m->depths) mpm_face_depths_make(m->depths);
    for (int i = s->bodies - 1; i >= 0; i--) {
        group_info *g = &m->group[s->body[i].group];
        g->first = i;
        memcpy(g->passes, s->body[i].passes, sizeof g->passes);
        g->held = s->body[i].held;
        if (++g->bodies > m->most_bodies) m->most_bodies = g->bodies;
    }
    for (int i = 0; i < s->bodies; i++) {
        group_info *g = &m->group[s->body[i].group];
        g->mixed = g->mixed || unlike(m, g->first, i);
    }
    m->rule[0] = rule_from(&(mpm_pair){ .a = 0, .b = 1, .contact = s->contact, .normal_of = 0 });
    for (int i = 0; i < s->pairs; i++) {
        const mpm_pair *p = &s->pair[i];
        m->rule[i + 1] = rule_from(p);
        m->rule_of[p->a * m->groups + p->b] = m->rule_of[p->b * m->groups + p->a] = i + 1;
    }
    return status_ok();
}

static status build_bodies(mpm *m)
{
    const build_sink sink = { insert_point, m };
    for (int i = 0; i < m->scene.bodies; i++)
        TRY(mpm_build_body(&m->scene, i, &m->laws[i], &m->grids, &mpm_build_everywhere, &sink));
    return status_ok();
}

static double loaded_area(const mpm *m, int body)
{
    double sum = 0;
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                for (int l = 0; l < LANES && m->links[q].body == body; l++) sum += m->blocks[q].area[0][l];
    return sum;
}

/* A load without a surface would act on nothing. */
static status check_loads(mpm *m)
{
    for (int i = 0; i < m->scene.bodies; i++) {
        const mpm_body *b = &m->scene.body[i];
        if (!mpm_build_is_loaded(b)) continue;
        m->refused = (mpm_refused){ MPM_PART_BODY, i, "traction_face" };
        CHECK(loaded_area(m, i) > 0, STATUS_BAD_INPUT,
              "body `%s`: its traction or wave acts on nothing: none of its surface that looks towards %s lies in the "
              "window, free of later bodies",
              b->name, mpm_face_names[b->traction_face]);
    }
    return status_ok();
}

/* Least way of a group's points to an end of the window, in cells there. */
static double way_to_end(const mpm *m, int group, int face)
{
    const int k = face / 2;
    double least = HUGE_VAL;
    for (int i = 0; i < m->bricks_used; i++) {
        const brick *b = &m->bricks[i];
        const axis *a = &axes_of(m, b)[k];
        const double end = face % 2 ? m->scene.axis[k].hi : m->scene.axis[k].lo;
        const double size = face % 2 ? axis_left(a, a->last) : axis_right(a, 1);
        for (int c = 0; c < BRICK_CELLS && b->group == group; c++)
            for (int q = b->head[c]; q >= 0; q = m->links[q].next)
                for (unsigned left = m->links[q].mask; left; left &= left - 1) {
                    const int l = __builtin_ctz(left);
                    least = fmin(least, (fabs(m->blocks[q].x[k][l] - end) - m->blocks[q].half[k][l]) / size);
                }
    }
    return least;
}

/* An end that holds what it acts on holds a group for good that begins at it, as its own other half or its own support.
 * One that comes to it touches it. */
static void find_arrivals(mpm *m)
{
    static const double BESIDE = 0.05; /* cells */
    for (int g = 0; g < m->groups; g++)
        for (int face = 0; face < MPM_FACES; face++) {
            const mpm_boundary_kind kind = m->scene.axis[face / 2].boundary[face % 2];
            const bool holds = kind != MPM_BOUNDARY_FREE && kind != MPM_BOUNDARY_ABSORBING;
            m->group[g].arrives[face] = holds && !m->group[g].passes[face] && way_to_end(m, g, face) > BESIDE;
            m->arrivals = m->arrivals || m->group[g].arrives[face] || kind == MPM_BOUNDARY_ABSORBING;
        }
}

static status fill(mpm *m)
{
    TRY(make_laws(m));
    TRY(make_groups(m));
    TRY(mpm_grids_make(&m->scene, &m->grids));
    TRY(mpm_store_make(m, START_BLOCKS));
    TRY(mpm_reading_make(m));
    bool again = true;
    for (int i = 0; again; i++) {
        TRY(mpm_store_empty(m, 0));
        TRY(build_bodies(m));
        TRY(mpm_refine_flags(m, &again)); /* as fine as the rules want it from the start */
        again = again && i < m->grids.levels;
    }
    TRY(check_loads(m));
    find_arrivals(m);
    TRY(mpm_cavities_make(m));
    return mpm_store_settle(m);
}

/* Fastest crossing of a cell at the start [1/s] */
static double first_rate(const mpm *m)
{
    double fastest = 0;
    for (int i = 0; i < m->scene.bodies; i++) {
        const law *k = &m->laws[i];
        const double spin = mpm_build_spin_speed(&m->scene, i), *v = m->scene.body[i].velocity;
        const double sound = mpm_law_start_sound(k);
        for (int q = 0; q < 3; q++)
            fastest = fmax(fastest, (sound + fabs(v[q]) + spin) / m->grids.level[0].axes[q].smallest);
    }
    return fastest;
}

static double first_step(const mpm *m)
{
    return m->scene.courant / first_rate(m) * level_steps(m, 0);
}

static void start_ledger(mpm *m)
{
    const mpm_ledger now = mpm_balance(m);
    m->ledger.energy_start = now.kinetic + now.internal;
    m->ledger.kinetic_start = now.kinetic;
    m->ledger.mass_start = now.mass;
    memcpy(m->ledger.momentum_start, now.momentum, sizeof now.momentum);
    m->dt = first_step(m);
    m->report.particles = mpm_points(m);
    for (int i = 0; i < m->scene.bodies; i++)
        m->report.peak_temperature = fmax(m->report.peak_temperature, m->scene.body[i].temperature);
}

/* Material points that a lattice of the finest cells everywhere would take. */
static double dense_particles(const mpm *m)
{
    const double n = m->scene.particles_per_axis;
    const mpm_axis *fine = m->scene.axis;
    const double v = fine[0].fine * fine[1].fine * fine[2].fine / (n * n * n);
    double volume = 0;
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                for (int l = 0; l < LANES; l++) volume += m->blocks[q].mass[0][l] / m->blocks[q].rho[0][l];
    return volume / v;
}

/* What is made for each thread is there for MPM_MAX_THREADS of them. */
void mpm_set_threads(mpm *m, int threads)
{
    m->threads = threads > 0 ? threads : omp_get_max_threads();
    if (m->threads > MPM_MAX_THREADS) m->threads = MPM_MAX_THREADS;
}

void mpm_set_finest(mpm *m, int level)
{
    m->finest = level;
}

/* What is refused once points are made is said of what *at names then. */
static status create(const mpm_scene *scene, int threads, mpm_refused *at, mpm **out)
{
    *out = NULL;
    TRY(mpm_check(scene, at));
    const kernels *kernel = mpm_kernels_choose(scene->instruction_set);
    CHECK(kernel, STATUS_BAD_INPUT,
          "instruction set `%s` is unknown or this machine lacks it: use x86-64-v4, x86-64-v3 or portable",
          scene->instruction_set);
    mpm *m = aligned_alloc(64, (sizeof *m + 63) / 64 * 64);
    CHECK(m, STATUS_MEMORY, "no memory for the solver");
    memset(m, 0, sizeof *m);
    mpm_set_threads(m, threads);
    m->kernel = kernel;
    status s = mpm_scene_copy(scene, &m->scene);
    mpm_scene_levels_fill(&m->scene);
    if (s.code == STATUS_OK) s = fill(m);
    if (s.code != STATUS_OK) {
        *at = m->refused;
        mpm_free(m);
        return s;
    }
    start_ledger(m);
    m->scene_key = mpm_scene_hash(&m->scene);
    m->dense = dense_particles(m);
    *out = m;
    return s;
}

status mpm_create(const mpm_scene *scene, int threads, mpm **out)
{
    mpm_refused at;
    return create(scene, threads, &at, out);
}

/* A piston's wave that does not arrive. */
static status check_wave(const mpm_scene *s, int body, mpm_refused *at)
{
    law k;
    mpm_wave w;
    if (isnan(s->body[body].piston_mass)) return status_ok();
    *at = (mpm_refused){ MPM_PART_BODY, body, "tube_length" };
    TRY(mpm_law_make(&s->body[body], s, &k));
    const status made = mpm_wave_make(&s->body[body], &k, &w);
    mpm_wave_free(&w);
    return made;
}

status mpm_check_made(const mpm_scene *s, int threads, mpm_refused *at)
{
    mpm *m = NULL;
    TRY(mpm_check(s, at));
    for (int i = 0; i < s->bodies; i++) TRY(check_wave(s, i, at));
    if (s->cavities > 0) TRY(create(s, threads, at, &m));
    mpm_free(m);
    *at = mpm_not_refused;
    return status_ok();
}

void mpm_free(mpm *m)
{
    if (!m) return;
    mpm_store_free(m);
    mpm_cavities_free(m);
    mpm_reading_free(m);
    for (int i = 0; m->waves && i < m->scene.bodies; i++) mpm_wave_free(&m->waves[i]);
    free(m->waves), free(m->load);
    free(m->materials), free(m->laws), free(m->effusivity);
    free(m->body_report), free(m->peaks);
    free(m->group), free(m->rule), free(m->rule_of), free(m->depths);
    free(m->contact), free(m->force), free(m->scratch);
    mpm_grids_free(&m->grids);
    mpm_scene_free(&m->scene);
    free(m);
}

/* ---- the step ---- */

/* How many of the sites in a list by level are of this one or a finer one. */
static int sites_up_to(const mpm *m, const int to[MPM_MAX_LEVELS], int level)
{
    return to[level < m->grids.levels ? level : m->grids.levels - 1];
}

/* The coarsest level that has nodes with a step that ends now (substeps.c). */
static int coarsest_due(const mpm *m)
{
    return m->ends + 2;
}

static void phase_p2g(mpm *m)
{
    loop_runs bricks;
    mpm_runs_of_bricks(&bricks, m);
#pragma omp parallel num_threads(m->threads)
    for (int i, end; mpm_runs_take(&bricks, omp_get_thread_num(), &i, &end);)
        for (; i < end; i++)
            if (m->bricks[i].particles > 0 && m->bricks[i].level <= m->begins) m->kernel->p2g(m, &m->bricks[i]);
}

/* Scratch memory for the groups at a site, for as many threads as there are now. */
static status reserve_scratch(mpm *m)
{
    if (m->crowd <= m->scratch_groups && m->threads <= m->scratch_threads) return status_ok();
    free(m->scratch);
    m->scratch_bytes = m->kernel->node_bytes(m->crowd);
    m->scratch = aligned_alloc(64, (size_t)m->threads * m->scratch_bytes);
    m->scratch_groups = m->scratch ? m->crowd : 0, m->scratch_threads = m->threads;
    CHECK(m->scratch, STATUS_MEMORY, "no memory for %d groups that meet in a brick", m->crowd);
    return status_ok();
}

/* Nodes that two levels share: sums there first, velocities of those that follow last. */
static void phase_nodes(mpm *m)
{
    const int due = coarsest_due(m), gathered = m->begins > due ? m->begins : due;
    const int nodes = sites_up_to(m, m->sites_to, due), interfaces = sites_up_to(m, m->interfaces_to, due);
    const int lines = sites_up_to(m, m->interfaces_to, gathered);
    loop_runs of_lines, to_add, of_nodes, to_touch, to_constrain, to_store;
    mpm_runs_even(&of_lines, m->threads, lines);
    mpm_runs_even(&to_add, m->threads, interfaces);
    mpm_runs_even(&of_nodes, m->threads, nodes);
    mpm_runs_even(&to_touch, m->threads, nodes);
    mpm_runs_even(&to_constrain, m->threads, interfaces);
    mpm_runs_even(&to_store, m->threads, interfaces);
#pragma omp parallel num_threads(m->threads)
    {
        const int t = omp_get_thread_num();
        for (int i, end; mpm_runs_take(&of_lines, t, &i, &end);)
            for (; i < end; i++) {
                m->kernel->gather(m, m->interface_list[i]);
                mpm_substep_restore(m, m->interface_list[i]);
            }
#pragma omp barrier
        for (int i, end; mpm_runs_take(&to_add, t, &i, &end);)
            for (; i < end; i++) mpm_interface_add_sums(m, m->interface_list[i]);
#pragma omp barrier
        for (int i, end; mpm_runs_take(&of_nodes, t, &i, &end);)
            for (; i < end; i++) m->kernel->nodes(m, m->site_list[i], t);
        if (m->groups > 1) {
#pragma omp barrier
            for (int i, end; mpm_runs_take(&to_touch, t, &i, &end);)
                for (; i < end; i++) m->kernel->touch(m, m->site_list[i], t);
        }
#pragma omp barrier
        for (int i, end; mpm_runs_take(&to_constrain, t, &i, &end);)
            for (; i < end; i++) mpm_interface_constrain(m, m->interface_list[i]);
#pragma omp barrier
        for (int i, end; mpm_runs_take(&to_store, t, &i, &end);)
            for (; i < end; i++) mpm_substep_store(m, m->interface_list[i]);
    }
}

static void g2p_of(mpm *m, brick *b, int thread)
{
    b->movers = 0, b->mover_steps = 0;
    if (b->level > m->ends) return;
    if (b->particles > 0)
        m->kernel->g2p(m, b, thread);
    else
        memset(&b->sum, 0, sizeof b->sum), b->sum.bad_block = -1;
}

static void phase_g2p(mpm *m)
{
    loop_runs bricks;
    mpm_runs_of_bricks(&bricks, m);
    for (int t = 0; t < m->threads; t++) m->movers[t].count = 0;
#pragma omp parallel num_threads(m->threads)
    for (int i, end; mpm_runs_take(&bricks, omp_get_thread_num(), &i, &end);)
        for (; i < end; i++) g2p_of(m, &m->bricks[i], omp_get_thread_num());
}

static double larger(double a, double b) /* b NaN: a */
{
    return b > a ? b : a;
}

static void add_vector(double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) a[k] += b[k];
}

/* What bricks book in G2P and movers.c, but for the boundaries' impulse. */
static void add_points(tally *a, const tally *b)
{
    a->heat_transfer += b->heat_transfer, a->heat_viscous += b->heat_viscous;
    a->work_external += b->work_external;
    add_vector(a->impulse_external, b->impulse_external);
    a->left.count += b->left.count, a->left.mass += b->left.mass, a->left.energy += b->left.energy;
    add_vector(a->left.momentum, b->left.momentum);
    a->rate = larger(a->rate, b->rate);
    a->peak_temperature = larger(a->peak_temperature, b->peak_temperature);
    a->clamps_pressure += b->clamps_pressure, a->clamps_compression += b->clamps_compression;
    a->splits += b->splits, a->eroded += b->eroded, a->eroded_mass += b->eroded_mass;
    a->particles += b->particles, a->asleep += b->asleep;
}

/* What sites book, contact and boundaries, but for the impulse of a gas. */
static void add_nodes(tally *a, const tally *b)
{
    a->heat_friction += b->heat_friction, a->work_boundary += b->work_boundary;
    add_vector(a->impulse_boundary, b->impulse_boundary);
}

/* Contact impulses: of a share of the sites; of all. */
static double (*share_contact(const mpm *m, int share))[3]
{
    return m->contact + (ptrdiff_t)(1 + share) * m->groups;
}

static void add_contact(const mpm *m, int site, double (*to)[3])
{
    for (int f = 0; f < m->groups; f++) {
        const int i = brick_of_site(m, site, f);
        if (i >= 0) add_vector(to[f], m->bricks[i].contact_impulse);
    }
}

static void collect_share(const mpm *m, int share, tally *sum)
{
    memset(sum, 0, sizeof *sum);
    sum->bad_block = -1;
    for (int i = share_begin(m->bricks_used, share); i < share_begin(m->bricks_used, share + 1); i++) {
        const tally *t = &m->bricks[i].sum;
        if (t->particles + t->asleep == 0 || m->bricks[i].level > m->ends) continue;
        sum->stranded = sum->stranded || t->stranded;
        if (sum->bad_block < 0) sum->bad_block = t->bad_block, sum->bad_lane = t->bad_lane;
        add_points(sum, t);
        add_vector(sum->impulse_boundary, t->impulse_boundary);
    }
    double(*contact)[3] = share_contact(m, share);
    memset(contact, 0, (size_t)m->groups * sizeof *contact);
    const int sites = sites_up_to(m, m->sites_to, coarsest_due(m));
    for (int i = share_begin(sites, share); i < share_begin(sites, share + 1); i++) {
        const tally *t = &m->site_sum[m->site_list[i]];
        add_nodes(sum, t);
        sum->stranded = sum->stranded || t->stranded;
        add_vector(sum->impulse_external, t->impulse_external);
        if (t->shared) add_contact(m, m->site_list[i], contact);
    }
}

/* What the threads' points reached in a step, into the bodies' peaks; the threads begin anew. */
static void take_peaks(mpm *m)
{
    mpm_report *r = &m->report;
    for (int t = 0; t < m->threads; t++) {
        body_peaks *p = peaks_of_thread(m, t);
        for (int i = 0; i < m->scene.bodies; i++) {
            mpm_body_report *b = &m->body_report[i];
            b->peak_mises = fmax(b->peak_mises, p[i].mises);
            b->peak_pressure = fmax(b->peak_pressure, p[i].pressure);
            b->peak_plastic_strain = fmax(b->peak_plastic_strain, p[i].strain);
            r->peak_pressure = fmax(r->peak_pressure, p[i].pressure);
        }
        memset(p, 0, (size_t)m->scene.bodies * sizeof *p);
    }
}

static status check_share(const mpm *m, const tally *t)
{
    CHECK(!t->stranded, STATUS_MEMORY, "t = %g s: no memory for points that change their cells, or for contacts",
          m->time);
    if (t->bad_block < 0) return status_ok();
    const block *q = &m->blocks[t->bad_block];
    const int l = t->bad_lane;
    return base_status_error(STATUS_NUMERICAL,
                             "t = %g s, step %llu: the point of `%s` that started at (%g, %g, %g) m is not "
                             "finite; try a smaller courant (now %g) or larger viscosity",
                             m->time, (unsigned long long)m->steps, m->scene.body[m->links[t->bad_block].body].name,
                             q->start[0][l], q->start[1][l], q->start[2][l], m->scene.courant);
}

/* Adds up in the order of bricks and sites, whatever the threads did. */
static status collect(mpm *m, tally *sum)
{
    tally share[SHARES];
#pragma omp parallel for schedule(static) num_threads(m->threads)
    for (int i = 0; i < SHARES; i++) collect_share(m, i, &share[i]);
    for (int i = 0; i < SHARES; i++) {
        TRY(check_share(m, &share[i]));
        add_points(sum, &share[i]);
        add_nodes(sum, &share[i]);
        for (int f = 0; f < m->groups; f++) add_vector(m->contact[f], share_contact(m, i)[f]);
    }
    take_peaks(m);
    return status_ok();
}

void mpm_book_departure(mpm *m, const departure *d)
{
    m->report.ejected += d->count;
    m->ledger.ejected_mass += d->mass, m->ledger.ejected_energy += d->energy;
    for (int k = 0; k < 3; k++) m->ledger.ejected_momentum[k] += d->momentum[k];
}

static void book(mpm *m, const tally *t)
{
    mpm_ledger *l = &m->ledger;
    mpm_report *r = &m->report;
    l->heat_friction += t->heat_friction;
    l->heat_transfer += t->heat_transfer - t->heat_friction; /* the points' part held both */
    l->heat_viscous += t->heat_viscous;
    l->work_boundary += t->work_boundary, l->work_external += t->work_external;
    mpm_book_departure(m, &t->left);
    for (int k = 0; k < 3; k++) {
        l->impulse_boundary[k] += t->impulse_boundary[k];
        l->impulse_external[k] += t->impulse_external[k];
        for (int g = 0; g < m->groups; g++) m->force[g].last[k] = m->contact[g][k] / m->dt;
    }
    r->peak_temperature = fmax(r->peak_temperature, t->peak_temperature);
    r->clamps_pressure += t->clamps_pressure, r->clamps_compression += t->clamps_compression;
    r->splits += t->splits, r->eroded += t->eroded, r->eroded_mass += t->eroded_mass;
    r->particle_steps += t->particles, r->particle_steps_asleep += t->asleep;
    r->particles = mpm_points(m);
}

/* First-order low pass, so that the peaks do not hang on one step's noise. */
static void smooth_forces(mpm *m)
{
    const double share = 1 - exp(-m->dt / FORCE_SMOOTHING);
    for (group_force *g = m->force; g < m->force + m->groups; g++)
        for (int k = 0; k < 3; k++) {
            g->smooth[k] += share * (g->last[k] - g->smooth[k]);
            g->peak[k] = fmax(g->peak[k], fabs(g->smooth[k]));
        }
}

static void lap(mpm *m, mpm_phase phase, double *since)
{
    const double now = omp_get_wtime();
    m->phase_seconds[phase] += now - *since;
    *since = now;
}

double mpm_phase_seconds(const mpm *m, mpm_phase phase)
{
    return m->phase_seconds[phase];
}

/* The coarsest level that begins its step with number n of the finest. */
static int coarsest_at(const mpm *m, int n)
{
    int level = 0;
    while (level + 1 < m->grids.levels && n % (level_steps(m, 0) / level_steps(m, level + 1)) == 0) level++;
    return level;
}

/* Of the levels that begin a step with number n of the finest, each in the middle of its own. */
static status begin_waves(mpm *m, int n)
{
    const double from = m->time + n * level_dt(m, 0);
    for (int i = 0; i < m->scene.bodies; i++) {
        if (!mpm_wave_is_wanted(&m->scene.body[i])) continue;
        TRY(mpm_wave_reach(&m->waves[i], from + 0.5 * level_dt(m, m->begins)));
        for (int level = 0; level <= m->begins; level++)
            m->load[level * m->scene.bodies + i] =
                mpm_wave_load(&m->waves[i], &m->scene.body[i], &m->laws[i], from + 0.5 * level_dt(m, level));
    }
    return status_ok();
}

/* Step n of the finest level, and of those that begin or end theirs with it. */
static status one_substep(mpm *m, int n, tally *sum)
{
    double clock = omp_get_wtime();
    m->begins = coarsest_at(m, n), m->ends = coarsest_at(m, n + 1), m->substeps++;
    TRY(reserve_scratch(m));
    TRY(mpm_cavities_reserve(m));
    TRY(begin_waves(m, n));
    phase_p2g(m), lap(m, MPM_PHASE_P2G, &clock);
    phase_nodes(m);
    TRY(mpm_cavities_step(m));
    lap(m, MPM_PHASE_NODES, &clock);
    phase_g2p(m), lap(m, MPM_PHASE_G2P, &clock);
    TRY(collect(m, sum));
    lap(m, MPM_PHASE_REST, &clock);
    TRY(mpm_movers_exchange(m));
    lap(m, MPM_PHASE_MOVERS, &clock);
    m->dt_last = m->dt; /* for levels that begin from here on */
    return status_ok();
}

/* Steps of the coarsest level between what is done every so many of the finest, when all are in step. */
static int steps_between(const mpm *m, int every)
{
    const int steps = every / level_steps(m, 0);
    return steps > 1 ? steps : 1;
}

static bool is_due(const mpm *m, int every)
{
    return m->steps % (uint64_t)steps_between(m, every) == 0;
}

static void relax_bricks(mpm *m, relax_pass pass, int nth, double time)
{
    loop_runs bricks;
    mpm_runs_of_bricks(&bricks, m);
#pragma omp parallel num_threads(m->threads)
    for (int i, end; mpm_runs_take(&bricks, omp_get_thread_num(), &i, &end);)
        for (; i < end; i++) m->kernel->relax(m, &m->bricks[i], pass, nth, time);
}

/* A body at a time, since pressure may jump where two are welded. */
static void relax_pressures(mpm *m)
{
    const double time = steps_between(m, RELAX_EVERY) * m->dt_last;
    relax_bricks(m, RELAX_LOOK, 0, time);
    for (int nth = 0; nth < m->most_bodies; nth++)
        for (relax_pass pass = RELAX_SUMS; pass <= RELAX_POINTS; pass++) relax_bricks(m, pass, nth, time);
}

/* The point with the most energy, of motion and heat, by mass. */
static void hottest_point(const mpm *m, int *index, int *lane)
{
    double largest = -HUGE_VAL;
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int n = m->bricks[i].head[c]; n >= 0; n = m->links[n].next)
                for (unsigned left = m->links[n].mask; left; left &= left - 1) {
                    const int l = __builtin_ctz(left);
                    const double v[3] = { m->blocks[n].v[0][l], m->blocks[n].v[1][l], m->blocks[n].v[2][l] };
                    const double energy = m->blocks[n].e[0][l] + 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
                    if (energy > largest) largest = energy, *index = n, *lane = l;
                }
}

/* A run whose steps shrink without end would never come to its own.  `longest`: that its fastest point allows [s] */
static status check_step(const mpm *m, double longest)
{
    int i = -1, l = 0;
    CHECK(isfinite(m->dt) && m->dt > 0, STATUS_NUMERICAL, "t = %g s: the time step became %g s; try a smaller courant",
          m->time, m->dt);
    if (longest >= DT_LEAST * first_step(m)) return status_ok();
    hottest_point(m, &i, &l);
    if (i < 0) return status_ok();
    const block *q = &m->blocks[i];
    return base_status_error(STATUS_NUMERICAL,
                             "t = %g s, step %llu: the time step has fallen from %g to %g s: the point of `%s` that "
                             "started at (%g, %g, %g) m has %g K and %g m/s; try a smaller courant (now %g), larger "
                             "viscosity, or a material that melts",
                             m->time, (unsigned long long)m->steps, first_step(m), longest,
                             m->scene.body[m->links[i].body].name, q->start[0][l], q->start[1][l], q->start[2][l],
                             q->T[0][l], hypot(hypot(q->v[0][l], q->v[1][l]), q->v[2][l]), m->scene.courant);
}

/* From one moment at which all levels are in step to the next. */
static status one_step(mpm *m, double until)
{
    tally sum = { .rate = 0 };
    memset(m->contact, 0, (size_t)m->groups * sizeof *m->contact);
    const double wanted = m->dt, left = until - m->time;
    if (left < 2 * wanted) m->dt = left <= wanted * (1 + 1e-9) ? left : 0.5 * left; /* no tiny last step */
    for (int n = 0; n < level_steps(m, 0); n++) TRY(one_substep(m, n, &sum));
    double clock = omp_get_wtime();
    book(m, &sum);
    smooth_forces(m);
    m->time += m->dt;
    m->steps++;
    m->dense_steps += m->dense * level_steps(m, 0);
    const double longest = sum.rate > 0 ? m->scene.courant / sum.rate : wanted;
    m->dt = fmin(longest, DT_GROWTH * wanted);
    TRY(check_step(m, longest));
    if (is_due(m, RELAX_EVERY) && m->scene.basis == MPM_BASIS_GIMP) relax_pressures(m);
    if (is_due(m, SAMPLE_EVERY)) mpm_sample_percentiles(m);
    if (is_due(m, MPM_CAVITY_EVERY)) mpm_cavities_look(m);
    if (m->blocks_scattered > (m->blocks_capacity - m->blocks_free) / SCATTERED) TRY(mpm_store_compact(m));
    if (is_due(m, mpm_refine_every(m->scene.refine, m->scene.refines))) TRY(mpm_refine_look(m));
    lap(m, MPM_PHASE_REST, &clock);
    return status_ok();
}

status mpm_advance(mpm *m, double until, const mpm_sink *sink)
{
    while (m->time < until * (1 - 1e-12)) {
        TRY(one_step(m, until));
        if (sink && sink->step && !sink->step(sink->user, m))
            return base_status_error(STATUS_STOPPED, "stopped at t = %g s", m->time);
    }
    return status_ok();
}
