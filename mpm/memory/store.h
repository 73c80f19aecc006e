/* SPDX-License-Identifier: BSD-3-Clause */
/* The solver's memory: points in blocks of eight, blocks chained by cell, cells in bricks of 4 x 4 x 4.
 *
 *   block   8 points of one body and one cell, array of structures of arrays; holes have mass 0
 *   brick   64 cells of one group; `out` are the node sums of its own points on its 6 x 6 x 6 nodes (own nodes
 *           and one layer around), `mpm.nodes` the velocities of its own 4 x 4 x 4 nodes
 *   site    the bricks of all groups at one place of one level of the nested grids (grid.h)
 * A step (mpm.c) of a level: P2G over bricks -> sums over sites, contact, boundaries -> G2P over bricks -> movers
 * change cells. Every phase reads what the last one wrote and writes only its own brick, in an order that no thread
 * changes: the same bits on any number of threads. */
#ifndef BREECH_MPM_STORE_H
#define BREECH_MPM_STORE_H

#include "mpm/grid/grid.h"
#include "mpm/kernel/lanes.h"
#include "mpm/law/law.h"
#include "mpm/mpm.h"
#include "mpm/wave.h"

#include <math.h>

enum {
    BRICK = 4,                           /* cells a brick and axis */
    BRICK_CELLS = BRICK * BRICK * BRICK, /* 64 */
    HALO = BRICK + 2,                    /* nodes a brick's points see, an axis */
    HALO_NODES = HALO * HALO * HALO,     /* 216 */
    LINE = 8,                            /* doubles of a node line */
    NODE = 4,                            /* vx vy vz E of a finished node */
    NEIGHBOURS = 27,
    SELF = 13,        /* index of the brick itself among them */
    BRICK_ASLEEP = 2, /* steps at rest after which a brick's points are left as they are */
    CROSSES = 27,     /* of a mover: to another level */
    MPM_MAX_THREADS = 256,
    SHARES = 32 /* of the bricks: what is summed over all of them is summed share by share, on any number of threads */
};

static inline int share_begin(int bricks, int share)
{
    return (int)((int64_t)bricks * share / SHARES);
}

/* One list makes the block, the copies of single points and the checkpoint.  P2G reads what comes before e, G2P all
 * before start. */
#define BLOCK_FIELDS(FIELD)                                                    \
    FIELD(x, 3)      /* position [m] */                                        \
    FIELD(v, 3)      /* velocity [m/s] */                                      \
    FIELD(L, 9)      /* velocity gradient, L[3 i + k] = dv_i/dx_k [1/s] */     \
    FIELD(s, 6)      /* stress deviator xx yy zz xy xz yz [Pa] */              \
    FIELD(p, 1)      /* pressure with viscosity [Pa] */                        \
    FIELD(rho, 1)    /* density [kg/m3] */                                     \
    FIELD(mass, 1)   /* [kg], 0 in a hole */                                   \
    FIELD(half, 3)   /* half lengths of the domain [m] */                      \
    FIELD(ka, 1)     /* specific kinetic energy of the gradient part [J/kg] */ \
    FIELD(area, 1)   /* face area that the body's traction acts on [m2] */     \
    FIELD(flow, 1)   /* flow stress of the last step [Pa] */                   \
    FIELD(e, 1)      /* specific internal energy [J/kg] */                     \
    FIELD(ep, 1)     /* equivalent plastic strain [1] */                       \
    FIELD(damage, 1) /* failed at 1 */                                         \
    FIELD(T, 1)      /* temperature [K] */                                     \
    FIELD(start, 3)  /* position at the start [m] */

typedef struct {
#define BLOCK_MEMBER(name, n) double name[n][LANES];
    BLOCK_FIELDS(BLOCK_MEMBER)
#undef BLOCK_MEMBER
} block __attribute__((aligned(64)));

enum { BLOCK_DOUBLES = sizeof(block) / (sizeof(double) * LANES) };

/* Places of the fields in a single point's BLOCK_DOUBLES. */
enum {
#define BLOCK_FIRST(name, n) FIRST_##name, LAST_##name = FIRST_##name + (n)-1,
    BLOCK_FIELDS(BLOCK_FIRST)
#undef BLOCK_FIRST
};

/* A point on its way between cells. */
typedef struct {
    int brick_step; /* which of the 27 neighbours it goes to; CROSSES: a brick of another level */
    int cell;       /* cell in that brick */
    int level;      /* of it */
    int at[3];      /* its place, of one that crosses */
    int body;
} mover_head;

typedef struct {
    int count, capacity;
    mover_head *head;
    double (*data)[BLOCK_DOUBLES];
} mover_list;

/* What has left: through the window's ends, or as dust. */
typedef struct {
    uint64_t count;
    double mass, momentum[3], energy; /* [kg, kg m/s, J] */
} departure;

/* What one brick, or one site, books in a step. */
typedef struct {
    double heat_friction, heat_transfer, heat_viscous; /* as mpm_ledger has them [J] */
    double work_boundary, work_external;               /* [J] */
    double impulse_boundary[3], impulse_external[3];   /* [N s] */
    departure left;
    double rate;             /* largest (c + |v|) / h, times the share of m.dt that the level's steps are [1/s] */
    double peak_temperature; /* [K] */
    uint64_t clamps_pressure, clamps_compression, splits, eroded, particles;
    uint64_t asleep;         /* points that were left as they are */
    double eroded_mass;      /* [kg] */
    bool stranded;           /* no memory for points that left their cells: the step cannot go on */
    bool shared;             /* of a site: its bricks' contact_impulse counts */
    int bad_lane, bad_block; /* first point that is not finite, bad_block = -1: none */
} tally;

/* Nodes of a brick (bits) that two levels share (interface.c). */
typedef struct {
    uint64_t follow_coarser, follow_finer; /* have their velocity from there */
    uint64_t lead_coarser, lead_finer;     /* receive sums of nodes that follow them there */
    uint64_t twice_finer; /* those of follow_finer where the node that they follow leads a still finer level */
} interface_nodes;

/* What a brick's points gave to its nodes, while a finer level makes several steps with those that both share
 * (substeps.c). */
typedef struct {
    double line[2 * BRICK_CELLS][LINE]; /* as brick.line; of shared nodes as their last step left it */
    double drift[BRICK_CELLS][3];       /* velocity that is still to be added for the points [m/s] */
    double owed[BRICK_CELLS];           /* the same of the energy [J] */
} node_shares;

typedef struct {
    int group, level;
    int at[3];                    /* brick coordinates */
    interface_nodes interface;    /* of its nodes */
    bool at_interface;            /* there are any */
    uint8_t foreign[BRICK_CELLS]; /* octants of each cell (bit 0: upper half along x) that another level has */
    bool across;                  /* another group has points near a node that this brick shares with another level */
    int head[BRICK_CELLS];        /* first block of each cell, -1 = none */
    int particles, blocks;
    bool fresh;                  /* points have come from another level since the last look (refine/merge.c) */
    int still;                   /* steps since a node of its points was not slow, up to BRICK_ASLEEP (g2p.c) */
    double still_rate;           /* sum.rate of the last of them [1/s] */
    bool uneven, relaxes;        /* has points to relax; it or one beside it does (relax.c) */
    bool given;                  /* `out` holds what its points give as they are */
    bool contact;                /* another group has points here or next door */
    uint64_t occupied, meets;    /* bit c: cell c has points; it may share nodes with another group */
    uint64_t open[3][2];         /* cells beside which, before and after along each axis, the group has no points */
    double steady_dt;            /* that its points' domains are long enough for [s] */
    uint64_t covered;            /* cells that may come to be occupied until bricks are made anew around them */
    uint64_t reached;            /* nodes that points in covered cells give to */
    bool wanted;                 /* those need this brick: it has them, their nodes, or nodes that these follow */
    int neighbour[NEIGHBOURS];   /* bricks of the same group around, -1 = none */
    double (*out)[LINE];         /* [216] m, px, py, pz, fx, fy, fz, kinetic energy; halo_place (kernels.h) */
    double (*out_contact)[LINE]; /* [216] V grad S (3), -m (x_i - x_p) (3), m flow, m effusivity (mixed) */
    double (*line)[LINE];        /* of a brick at an interface: [64] sums as in `out`, then [64] as in `out_contact` */
    node_shares *held;           /* of a brick that shares nodes with a finer level */
    int movers, movers_first, movers_thread; /* its part of the thread's mover list */
    uint32_t mover_steps;                    /* bit k: a mover goes to neighbour k */
    double contact_impulse[3];               /* of the step on its nodes, where tally.shared of its site [N s] */
    tally sum;
} brick;

typedef struct {
    int next; /* block of the same cell, -1 = none; also chains the free blocks */
    uint16_t body;
    uint8_t mask; /* lanes in use */
} block_link;

enum { MPM_BODIES_COUNTED = UINT16_MAX + 1 }; /* what block_link.body can tell apart */

/* Largest of a body's points in a step, by the thread that moved them. */
typedef struct {
    double pressure, mises, strain; /* [Pa, Pa, 1] */
} body_peaks;

/* What of a body lies above its largest percentiles so far, lane by lane (read.c). */
typedef struct body_tops body_tops;

typedef struct kernels kernels;

typedef struct {
    int first, bodies;       /* body of the lowest number; how many it has */
    bool passes[MPM_FACES];  /* mpm_body.passes */
    bool held;               /* mpm_body.held */
    bool arrives[MPM_FACES]; /* an end that holds what it acts on, and that the group did not begin at: it touches it */
    bool mixed; /* its bodies differ in what a node asks of them: effusivity, wave speeds, pressure at the start */
} group_info;

/* A contact as the kernels want it. */
typedef struct {
    int law; /* index in contact.def */
    double value[MPM_CONTACT_VALUES];
    bool normal_of_higher; /* of the two groups; else the surface of the lower gives the normal */
} touch_rule;

/* Two groups at a node that both have a part of, before any contact acts there (kernel/nodes.c). */
typedef struct {
    int group[2];                            /* a < b */
    int along;                               /* axis nearest to the normal */
    double n[3];                             /* unit normal from a to b */
    double apart[3];                         /* v_b - v_a, forces of the step included [m/s] */
    double area, gap, width, shear, reduced; /* as contact_touch has them, of this node alone */
} touch_node;

/* A group at such a node: what its contacts and its end need. */
typedef struct {
    int brick;
    double m, heat, v[3], v_start[3], absorbed[3], extra[LINE];
} touch_trial;

/* The nodes of a site that groups share, of the finest level's step number `step`, in the order of cells. */
typedef struct {
    uint64_t step;
    int count, capacity, trials, trial_capacity;
    touch_node *node;
    touch_trial *trial;
    int first[BRICK_CELLS + 1], first_trial[BRICK_CELLS + 1];
} touch_site;

/* Contact force on a group from all others. */
typedef struct {
    double last[3];   /* mean of the last step [N] */
    double smooth[3]; /* its first-order low pass [N] */
    double peak[3];   /* largest |component| of that so far [N] */
} group_force;

struct mpm {
    mpm_scene scene;
    mpm_material *materials; /* [scene.bodies] */
    law *laws;               /* [scene.bodies] */
    double *effusivity;      /* [scene.bodies] sqrt(k rho c), NAN: not known [W s^1/2/m2/K] */
    mpm_wave *waves;         /* [scene.bodies] */
    wave_load *load; /* [grids.levels][scene.bodies] of the waves, over the step of each level that is under way */
    grids grids;
    int groups;
    group_info *group;             /* [groups] */
    int most_bodies;               /* of any group */
    bool arrivals;                 /* has any of them an end that it arrives at? */
    struct face_depths *depths;    /* grid/face_depth.h; NULL: one group alone */
    touch_rule *rule;              /* [1 + scene.pairs] the first for two groups that no pair names */
    int *rule_of;                  /* [groups x groups] */
    struct mpm_cavities *cavities; /* memory/cavities.h; NULL: the scene has none */
    int *directory;                /* [places][groups] brick or -1 */
    tally *site_sum;               /* [places] */
    touch_site *touch;             /* [places] */
    uint64_t substeps;             /* steps of the finest level so far, the one under way included */
    int places;                    /* that the four arrays of places have room for */

    brick *bricks;
    double (*nodes)[BRICK_CELLS][NODE]; /* of each brick: vx, vy, vz, specific energy that is left to the points */
    int bricks_used, bricks_capacity;
    int *site_list, site_count;                                  /* sites that have a brick, by level */
    int *interface_list, interface_count;                        /* those of them where levels meet */
    int sites_to[MPM_MAX_LEVELS], interfaces_to[MPM_MAX_LEVELS]; /* how many of each are of a level or a finer one */

    block *blocks;
    block_link *links;
    int blocks_capacity, blocks_free, free_head;
    int blocks_scattered; /* taken from the chain of free ones since mpm_store_compact */

    mover_list movers[MPM_MAX_THREADS];
    int threads;
    int crowd;     /* groups at the site that has the most */
    char *scratch; /* of the kernel of nodes: scratch_bytes for each of scratch_threads, for scratch_groups at a site */
    size_t scratch_bytes;
    int scratch_groups, scratch_threads;
    const kernels *kernel;

    double time, dt, dt_last; /* steps of the coarsest level; dt_last: the last that began, 0 before the first [s] */
    int begins, ends; /* levels 0 .. begins begin a step with the finest level's that is under way, 0 .. ends end one */
    uint64_t steps;
    int finest;                /* level that rules of refinement may ask for */
    double dense, dense_steps; /* points, and point-steps so far, of the finest cells everywhere */
    double *histogram;         /* of percentiles (read.c) */
    body_tops *tops;           /* [1 + SHARES][scene.bodies] of percentiles */
    double *failed;            /* [1 + SHARES][scene.bodies] for mpm_failed_volumes [m3] */
    body_peaks *peaks;         /* [MPM_MAX_THREADS][peaks_row] */
    size_t peaks_row;          /* bodies, and what keeps threads apart in memory */
    double (*contact)[3]; /* [1 + SHARES][groups] contact impulses of a step: all, then shares of the sites [N s] */
    mpm_report report;
    mpm_body_report *body_report; /* [scene.bodies] */
    group_force *force;           /* [groups] */
    mpm_ledger ledger;
    double phase_seconds[MPM_PHASES];
    uint64_t scene_key;  /* of everything that determines a scene */
    mpm_refused refused; /* while it is made: what the check under way is of */
};

/* Passes of pressure relaxation over all bricks: brick.uneven; then a body of each group at a time sums of what its
 * points have, sums of what they are to lose, and their loss (kernel/relax.c). */
typedef enum { RELAX_LOOK, RELAX_SUMS, RELAX_LOSSES, RELAX_POINTS } relax_pass;

struct kernels {
    const char *name;
    void (*p2g)(mpm *m, brick *b);
    void (*gather)(mpm *m, int site); /* an interface's sums into brick.line */
    void (*nodes)(mpm *m, int site, int thread);
    void (*touch)(mpm *m, int site, int thread); /* contacts at the nodes that groups share, after those of all sites */
    size_t (*node_bytes)(int groups);            /* of scratch memory, for a thread and that many groups at a site */
    void (*g2p)(mpm *m, brick *b, int thread);
    /* A pass over a brick, of the body with number `nth` of its group; `time` since the last relaxation [s]. */
    void (*relax)(mpm *m, brick *b, relax_pass pass, int nth, double time);
};

/* The kernels named (NULL or "" = mpm_instruction_set()); NULL if this machine cannot run them. */
const kernels *mpm_kernels_choose(const char *name);

/* bricks.c */
status mpm_store_make(mpm *m, int blocks);
status mpm_store_settle(mpm *m); /* after filling: neighbours, order in memory, room for the next step */
void mpm_store_release(mpm *m, int block_index);         /* back to the free blocks */
void mpm_store_release_cell(mpm *m, brick *b, int cell); /* all blocks of a cell */
void mpm_store_free(mpm *m);
status mpm_store_brick(mpm *m, int group, int level, const int at[3], int *out); /* finds or makes it */
status mpm_store_open(brick *b);                                                 /* memory for the sums of its points */
status mpm_store_empty(mpm *m, int blocks); /* no bricks, room for so many blocks */
/* Makes the bricks whose nodes points reach, or will within a cell's way, and finds them again: neighbours, contact
 * flags, site list.  Due when a cell is occupied that is not covered. */
status mpm_store_cover(mpm *m);
status mpm_store_relink(mpm *m); /* neighbours, contact flags, site list alone */
status mpm_store_prune(mpm *m); /* covers, without bricks that nothing wants; between two steps of the coarsest level */
void mpm_store_drop_lane(mpm *m, brick *b, int block_index, int lane); /* a point has left */
void mpm_store_tidy_cell(mpm *m, brick *b, int cell);                  /* gives back its empty blocks */
status mpm_store_reserve(mpm *m, int blocks); /* so many free blocks, and those for the next step */
status mpm_store_compact(mpm *m);             /* blocks into the order of bricks and cells */
int mpm_store_insert(mpm *m, brick *b, int cell, int body, const double *point); /* block, or -1 when none is free */

status mpm_store_place(mpm *m, int body, const double *point); /* makes its brick if need be; outside any step */
int mpm_store_cell_at(const mpm *m, int level, const double x[3],
                      int at[3]); /* cell and its brick's place; -1: outside */

/* interface.c: nodes that two levels share */
bool mpm_interface_changed(const mpm *m, const brick *b); /* may they be others since the last look (adapt.c)? */
/* Of a brick at this place, and of its cells the octants that other levels have (brick.foreign). */
interface_nodes mpm_interface_nodes(const mpm *m, int level, const int at[3], uint8_t foreign[BRICK_CELLS]);
status mpm_interface_want_bricks(mpm *m, int brick_index);   /* makes those of other levels that its nodes follow */
bool mpm_interface_in_contact(const mpm *m, const brick *b); /* brick.across */
void mpm_interface_add_sums(mpm *m, int site);               /* adds to brick.line what nodes of other levels hand on */
void mpm_interface_constrain(mpm *m, int site);              /* velocities of the nodes that follow another level */
/* Change of the motion from one node to the next along axis k, from nodes of more mass than `least` [kg]. */
void mpm_interface_slope(const mpm *m, const brick *b, int cell, int k, double least, double slope[3]);

/* substeps.c: nodes that a level shares with a finer one make the steps of that */
uint64_t mpm_substep_due(const mpm *m,
                         const brick *b); /* nodes that end a step with the finest level's that is under way */
double mpm_substep_dt(const mpm *m, const brick *b, int cell); /* of a node's step [s] */
void mpm_substep_restore(mpm *m, int site);                    /* brick.line as brick.held has it */
void mpm_substep_store(mpm *m, int site); /* into brick.held, or for its points, what a step has made of it */

/* cells_around.c: bits of a brick's cells */
uint64_t mpm_occupied_cells(const brick *b);
uint64_t mpm_contact_cells(const mpm *m, const brick *b);           /* brick.meets from what is occupied around */
uint64_t mpm_cells_around(const mpm *m, const brick *b, int reach); /* within `reach` (1, 2) of the group's occupied */
void mpm_cells_open(const mpm *m, const brick *b, int k, uint64_t open[2]); /* brick.open, nothing beyond a mirror */
uint64_t mpm_arrival_cells(const mpm *m, const brick *b); /* whose points give to nodes of ends that ask for its face */
bool mpm_near_arrival(const mpm *m, const brick *b, int reach); /* does such an end lie so many nodes away? */
uint64_t mpm_cells_of_layer(int k, int layer);                  /* one of BRICK across axis k */
uint64_t mpm_cells_towards(int step, int layers); /* so many layers of cells beside the neighbour at a step */

/* point.c: one point's BLOCK_DOUBLES */
void mpm_point_halve(double *q, double *other, int k);
void mpm_point_merge(double *q, const double *other, int k, double dt); /* the inverse: q takes other in */
void mpm_point_departure(const double *q, double dt, departure *sum);   /* dt: of the last step [s] */
void mpm_point_rescale_step(double *q, double dt, double other);        /* its last step counts as one of `other` [s] */

/* Work of the stress that a point has booked at the end of a step and the nodes will do before the next forces
 * (p2g.c): dt/2 sigma:L / rho [J/kg]. */
static inline double work_ahead(const double s[6], double p, const double L[9], double rho, double dt)
{
    const double deviator =
        s[0] * L[0] + s[1] * L[4] + s[2] * L[8] + s[3] * (L[1] + L[3]) + s[4] * (L[2] + L[6]) + s[5] * (L[5] + L[7]);
    return 0.5 * dt * (deviator - p * (L[0] + L[4] + L[8])) / rho;
}

/* Plastic power of a point: V s : D where it is intact and its Mises stress has reached 0.9 of its flow stress, else
 * 0 [W].  s in the order xx yy zz xy xz yz. */
static inline double lane_plastic_power(const block *q, int lane)
{
    static const double YIELDS = 0.9;
    const double limit = YIELDS * q->flow[0][lane];
    double square = 0, power = 0;
    if (q->damage[0][lane] >= 1) return 0;
    for (int i = 0; i < 6; i++) square += (i < 3 ? 1 : 2) * q->s[i][lane] * q->s[i][lane];
    if (1.5 * square < limit * limit) return 0;
    for (int i = 0; i < 3; i++) power += q->s[i][lane] * q->L[4 * i][lane];
    power += q->s[3][lane] * (q->L[1][lane] + q->L[3][lane]) + q->s[4][lane] * (q->L[2][lane] + q->L[6][lane]) +
             q->s[5][lane] * (q->L[5][lane] + q->L[7][lane]);
    return fmax(power, 0) * q->mass[0][lane] / q->rho[0][lane];
}

/* mpm.c */
void mpm_book_departure(mpm *m, const departure *d);

/* adapt.c: levels where the scene's rules want them, points to their levels.  flags: without moving a point; has any
 * place changed? */
status mpm_refine_flags(mpm *m, bool *changed);
status mpm_refine_look(mpm *m);
/* merge.c: joins points that lie in coarser cells than they need, deep in a sound body */
status mpm_merge_points(mpm *m);

/* read.c */
void mpm_sample_percentiles(mpm *m);
status mpm_reading_make(mpm *m); /* memory for the percentiles and the failed volumes */
void mpm_reading_free(mpm *m);

/* movers.c */
status mpm_movers_exchange(mpm *m); /* all movers into their new cells; makes bricks as needed */
void mpm_movers_take(mpm *m, brick *b, int cell, int block_index, int leaving);
bool mpm_movers_reserve(mover_list *list, int more);

/* Velocities and energies of a brick's own nodes.  In one array, so that those of 27 bricks are found without reading
 * the bricks. */
static inline double (*brick_nodes(const mpm *m, const brick *b))[NODE]
{
    return m->nodes[b - m->bricks];
}

/* Where the directory says which brick a group has at a site: more slots than an int counts may be needed. */
static inline size_t directory_slot(const mpm *m, int site, int group)
{
    return (size_t)site * (size_t)m->groups + (size_t)group;
}

/* Brick of a group at a site, -1 = none. */
static inline int brick_of_site(const mpm *m, int site, int group)
{
    return m->directory[directory_slot(m, site, group)];
}

/* The same at a place of a level. */
static inline int brick_at(const mpm *m, int group, int level, const int at[3])
{
    const int site = grids_place(&m->grids, level, at);
    return site >= 0 && site < m->places ? brick_of_site(m, site, group) : -1;
}

/* Steps that a level makes in one of the coarsest. */
static inline int level_steps(const mpm *m, int level)
{
    return 1 << (m->grids.levels - 1 - level);
}

static inline double level_dt(const mpm *m, int level)
{
    return m->dt / level_steps(m, level);
}

static inline double level_dt_last(const mpm *m, int level)
{
    return m->dt_last / level_steps(m, level);
}

/* Nodes that make the steps of a finer level. */
static inline uint64_t interface_shared(const interface_nodes *s)
{
    return s->lead_finer | s->follow_finer;
}

static inline bool interface_any(const interface_nodes *s)
{
    return (s->follow_coarser | s->follow_finer | s->lead_coarser | s->lead_finer) != 0;
}

static inline body_peaks *peaks_of_thread(const mpm *m, int thread)
{
    return m->peaks + (size_t)thread * m->peaks_row;
}

/* Of the group's first body. */
static inline const law *group_law(const mpm *m, int group)
{
    return &m->laws[m->group[group].first];
}

/* How two groups touch. */
static inline const touch_rule *touch_rule_of(const mpm *m, int a, int b)
{
    return &m->rule[m->rule_of[a * m->groups + b]];
}

static inline const axis *axes_of(const mpm *m, const brick *b)
{
    return m->grids.level[b->level].axes;
}

/* Place of a brick's neighbour; false: beyond the window. */
static inline bool brick_step_inside(const mpm *m, const brick *b, int step, int to[3])
{
    const int d[3] = { step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1 };
    for (int k = 0; k < 3; k++) {
        to[k] = b->at[k] + d[k];
        if (to[k] < 0 || to[k] >= axes_of(m, b)[k].bricks) return false;
    }
    return true;
}

static inline int cell_index(int i, int j, int k)
{
    return (k * BRICK + j) * BRICK + i;
}

#endif
