/* SPDX-License-Identifier: BSD-3-Clause */
/* Speed of the solver: ns of wall time a particle and step.
 *
 *   breech_bench_scene [--tiny] [--only WORD]... [steps [repetitions]]
 *
 * `cached` is `single` so small that it stays in the second-level cache; `mts` is `cached` with the copper of the
 * default shot, half hard, whose strength is a mechanical threshold.  `contact` is the paper's base case (an
 * armature ploughing over a grain on a rail, friction, graded grid); `single` is a block of the same number of points,
 * one body and one field, sheared so that it yields.  Each line: median, least and largest of the repetitions, each a
 * run of so many steps of one solver that goes on.  Nothing is judged here: what is printed holds for this machine and
 * whatever else ran on it.  `cpu` is the least processor time of all threads together: beside a busy neighbour it says
 * more than the wall; so do the phases, the least of each over the repetitions, best with one step a repetition.
 * --only leaves out what lacks the word: a scene's name, an instruction set or a number of threads. */
#include "mpm/law/contact.h"
#include "mpm/mpm.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MAX_REPETITIONS = 1000 };

enum { MAX_ONLY = 8 };

typedef struct {
    bool tiny;
    int steps, repetitions, onlies;
    const char *only[MAX_ONLY];
} options;

static double processor_time(void) /* of all threads [s] */
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct {
    mpm_material copper, aluminium;
    mpm_scene scene;
} bench_scene;

static void die(status s)
{
    if (s.code == STATUS_OK) return;
    fprintf(stderr, "bench_scene: %s\n", s.text);
    exit(1);
}

/* Rows ofhc_copper and w17_al7075 of the reference table. */
static void set_materials(bench_scene *b)
{
    mpm_material *c = &b->copper, *a = &b->aluminium;
    base_params_default(mpm_material_params, c);
    base_params_default(mpm_material_params, a);
    strcpy(c->name, "ofhc_copper"), strcpy(a->name, "w17_al7075");
    c->density = 8960, c->youngs_modulus = 124e9, c->poisson = 0.34, c->specific_heat = 383, c->conductivity = 386;
    c->yield_A = 90e6, c->hardening_B = 292e6, c->hardening_n = 0.31, c->rate_C = 0.025, c->softening_m = 1.09;
    c->damage_D1 = 0.54, c->damage_D2 = 4.89, c->damage_D3 = -3.03, c->damage_D4 = 0.014, c->damage_D5 = 1.12;
    c->sound_speed = 3940, c->hugoniot_slope = 1.489, c->gruneisen = 2.02, c->melting_temperature = 1356;
    a->density = 2810, a->youngs_modulus = 71e9, a->poisson = 0.33, a->specific_heat = 960;
    a->yield_A = 369e6, a->hardening_B = 684e6, a->hardening_n = 0.73, a->rate_C = 0.0083, a->softening_m = 1.7;
    a->damage_D1 = 0.13, a->damage_D2 = 0.13, a->damage_D3 = -1.5, a->damage_D4 = 0.011, a->damage_D5 = 0;
    a->sound_speed = 5350, a->hugoniot_slope = 1.34, a->gruneisen = 2, a->melting_temperature = 933;
    c->reference_temperature = a->reference_temperature = 293, c->rate_0 = a->rate_0 = 1;
    c->taylor_quinney = a->taylor_quinney = 0.9;
}

static mpm_body *add_body(mpm_scene *s, const char *shape, const double *values, int n, const mpm_material *m)
{
    mpm_body *b;
    die(mpm_scene_add_body(s, &b));
    snprintf(b->name, sizeof b->name, "%s", shape);
    b->material = m;
    mpm_solid *solid;
    die(mpm_scene_add_solid(s, shape, -1, -1, &solid));
    for (int i = 0; i < n; i++) solid->value[i] = values[i];
    b->solid = s->solids - 1;
    b->damage = true;
    return b;
}

static mpm_axis graded(double lo, double hi, double fine_lo, double fine_hi, double h)
{
    return (mpm_axis){
        .lo = lo, .hi = hi, .fine_lo = fine_lo, .fine_hi = fine_hi, .fine = h, .coarse = 5 * h, .growth = 1.25
    };
}

static void contact_scene(bench_scene *b, bool tiny)
{
    const double h = tiny ? 0.6e-3 : 0.27e-3;
    mpm_scene *s = &b->scene;
    mpm_scene_default(s);
    set_materials(b);
    s->axis[0] = graded(-33e-3, 20e-3, -2e-3, 8e-3, h);
    s->axis[1] = graded(-10e-3, 12.5e-3, -1.5e-3, 1.5e-3, h);
    s->axis[2] = graded(0, 15e-3, 0, 3e-3, h);
    s->axis[0].boundary[0] = s->axis[0].boundary[1] = MPM_BOUNDARY_ABSORBING;
    s->axis[1].boundary[0] = s->axis[1].boundary[1] = s->axis[2].boundary[0] = MPM_BOUNDARY_SYMMETRY;
    const double rail[] = { -33e-3, -10e-3, -1, 20e-3, 0, 1 }, grain[] = { 0, 0, 0, 0.5e-3, 0.5e-3 };
    /* half a U of 30 mm with a leg of 5 mm, a head of 10 mm and a chamfer of 2 mm at 30 degrees */
    const double front = -1e-3, nose = front + 2e-3 / tan(0.5236), back = nose - 30e-3, inner = nose - 10e-3;
    const double u[] = { -10e-3, 10e-3, 0,       0,     1,       back,  0,    front, 0,   nose,
                         2e-3,   nose,  12.5e-3, inner, 12.5e-3, inner, 5e-3, back,  5e-3 };
    add_body(s, "box", rail, 6, &b->copper);
    add_body(s, "hemisphere", grain, 5, &b->copper);
    mpm_body *armature = add_body(s, "prism", u, 19, &b->aluminium);
    armature->group = 1, armature->velocity[0] = 1500;
    armature->passes[0] = armature->passes[1] = true;
    s->contact.value[COULOMB_FRICTION] = 0.2;
}

/* n cells a side */
static void single_scene(bench_scene *b, int n)
{
    const double h = 1e-3;
    mpm_scene *s = &b->scene;
    mpm_scene_default(s);
    set_materials(b);
    for (int k = 0; k < 3; k++) s->axis[k] = graded(0, (n + 8) * h, 0, (n + 8) * h, h);
    const double middle = (n / 2 + 4) * h, lower[] = { 4 * h, 4 * h, 4 * h, (n + 4) * h, middle, (n + 4) * h };
    const double upper[] = { 4 * h, middle, 4 * h, (n + 4) * h, (n + 4) * h, (n + 4) * h };
    add_body(s, "box", lower, 6, &b->copper);
    add_body(s, "box", upper, 6, &b->copper)->velocity[0] = 300;
}

/* As ofhc_copper_half_hard of cases/materials. */
static void mts_scene(bench_scene *b)
{
    single_scene(b, 8);
    mpm_material *c = &b->copper;
    c->strength = MPM_STRENGTH_mts, c->cold_work = 0.27;
    c->mts_sigma_a = 40e6, c->mts_mu0 = 47.7e9, c->mts_D = 3e9, c->mts_T0 = 180, c->mts_k_b3 = 0.823e6, c->mts_g0 = 1.6;
    c->mts_rate = 1e7, c->mts_p = 0.666667, c->mts_q = 1, c->mts_a0 = 2390e6, c->mts_a1 = 12e6, c->mts_a2 = 1.696e6;
    c->mts_alpha = 2, c->mts_g0_s = 0.2625, c->mts_rate_s = 1e7, c->mts_sigma_s0 = 770e6;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool wanted(const options *o, const char *name, const char *set, int threads)
{
    char number[16];
    snprintf(number, sizeof number, "%d", threads);
    for (int i = 0; i < o->onlies; i++)
        if (strcmp(o->only[i], name) != 0 && strcmp(o->only[i], set) != 0 && strcmp(o->only[i], number) != 0)
            return false;
    return true;
}

/* Runs and prints one line; returns the least [ns], or 0 when it is not wanted or this machine lacks the set. */
static double measure(const char *name, const mpm_scene *base, const char *set, int threads, const options *o)
{
    if (!wanted(o, name, set, threads)) return 0;
    mpm_scene s = *base; /* the same bodies, borrowed */
    snprintf(s.instruction_set, sizeof s.instruction_set, "%s", set);
    mpm *m;
    if (mpm_create(&s, threads, &m).code != STATUS_OK) return 0;
    double ns[MAX_REPETITIONS], cpu = HUGE_VAL, seconds[MPM_PHASES], phase[MPM_PHASES];
    for (int p = 0; p < MPM_PHASES; p++) phase[p] = HUGE_VAL;
    mpm_report before = mpm_state(m);
    for (int r = -1; r < o->repetitions; r++) { /* the first warms up */
        for (int p = 0; p < MPM_PHASES; p++) seconds[p] = mpm_phase_seconds(m, p);
        const double start = omp_get_wtime(), start_cpu = processor_time();
        const uint64_t until = before.steps + (uint64_t)o->steps;
        mpm_report now = before;
        while (now.steps < until) {
            die(mpm_advance(m, now.time + (double)(until - now.steps) * now.dt * 0.999, NULL));
            now = mpm_state(m);
        }
        const double each = 1e9 / (double)(now.particle_steps - before.particle_steps);
        if (r >= 0) ns[r] = (omp_get_wtime() - start) * each, cpu = fmin(cpu, (processor_time() - start_cpu) * each);
        for (int p = 0; p < MPM_PHASES; p++) phase[p] = fmin(phase[p], (mpm_phase_seconds(m, p) - seconds[p]) * each);
        before = now;
    }
    qsort(ns, (size_t)o->repetitions, sizeof *ns, ascending);
    printf("%-8s  %-10s  %7d  %9zu  %8.1f  %8.1f  %8.1f  %8.1f ", name, set, threads, mpm_points(m),
           ns[o->repetitions / 2], ns[0], ns[o->repetitions - 1], cpu);
    for (int p = 0; p < MPM_PHASES; p++) printf(" %6.1f", phase[p]);
    printf("\n");
    fflush(stdout);
    mpm_free(m);
    return ns[0];
}

static bool read_options(int argc, char **argv, options *o)
{
    *o = (options){ .steps = 40, .repetitions = 7 };
    int numbers = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--tiny") == 0)
            o->tiny = true, o->steps = 3, o->repetitions = 2;
        else if (strcmp(argv[i], "--only") == 0 && i + 1 < argc && o->onlies < MAX_ONLY)
            o->only[o->onlies++] = argv[++i];
        else if (numbers < 2)
            *(numbers++ ? &o->repetitions : &o->steps) = atoi(argv[i]);
        else
            return false;
    }
    return o->steps >= 1 && o->repetitions >= 1 && o->repetitions <= MAX_REPETITIONS;
}

int main(int argc, char **argv)
{
    options o;
    if (!read_options(argc, argv, &o)) {
        fprintf(stderr, "usage: breech_bench_scene [--tiny] [--only WORD]... [steps [repetitions, at most %d]]\n",
                MAX_REPETITIONS);
        return 2;
    }
    static const char *const sets[] = { "x86-64-v4", "x86-64-v3", "portable" };
    bench_scene contact = { .scene = { 0 } }, single = { .scene = { 0 } }, cached = { .scene = { 0 } },
                mts = { .scene = { 0 } };
    contact_scene(&contact, o.tiny);
    single_scene(&single, o.tiny ? 6 : 36);
    single_scene(&cached, 8);
    mts_scene(&mts);
    printf("scene     set         threads  particles    median     least   largest       cpu   (ns a particle and "
           "step)\n");
    for (int i = 0; i < 3; i++) {
        double ns[2][2];
        for (int threads = 1; threads <= 2; threads++) {
            ns[0][threads - 1] = measure("single", &single.scene, sets[i], threads, &o);
            if (threads == 1 && !o.tiny) measure("cached", &cached.scene, sets[i], threads, &o);
            if (threads == 1 && !o.tiny) measure("mts", &mts.scene, sets[i], threads, &o);
            ns[1][threads - 1] = measure("contact", &contact.scene, sets[i], threads, &o);
        }
        if (ns[0][0] > 0 && ns[0][1] > 0 && ns[1][0] > 0 && ns[1][1] > 0)
            printf("%-8s  %-10s  two threads over one: single %.2f, contact %.2f; contact over single: %.2f\n", "ratio",
                   sets[i], ns[0][0] / ns[0][1], ns[1][0] / ns[1][1], ns[1][0] / ns[0][0]);
    }
    mpm_scene_free(&contact.scene), mpm_scene_free(&single.scene), mpm_scene_free(&cached.scene);
    mpm_scene_free(&mts.scene);
    return 0;
}
