#include "circuit/shot_model.h"

#include <math.h>

/* Held armatures are released once the force exceeds static friction by this [N]: a located root needs a sign change. */
static const double RELEASE_MARGIN = 1e-3;

static const double *tail(const shot_model *m, const double *y)
{
    return y + 2 * m->n;
}

bool shot_group_conducts(const shot_group *g)
{
    return g->mode == GROUP_ON || g->mode == GROUP_CROWBAR;
}

double shot_group_voltage(const shot_group *g, double w)
{
    return g->mode == GROUP_CROWBAR ? -g->p.crowbar_drop - g->p.crowbar_resistance * w : w;
}

/* mu(v) = mu1 + (mu0 - mu1) exp(-v/v_f)                                                   (C-4) */
static double friction_coefficient(const shot_armature *a, double v)
{
    return a->friction_melted + (a->friction_dry - a->friction_melted) * exp(-fmax(v, 0.0) / a->friction_speed);
}

/* Drag of the shocked gas ahead, p0 behind:  rho0 u_s v A,
 * u_s = (g + 1)/4 v + sqrt(((g + 1) v/4)^2 + a^2)                                         (C-5) [N] */
static double gas_drag(const shot_model *m, double v)
{
    const double half = 0.25 * (m->armature.gas_gamma + 1.0) * v;
    return m->armature.gas_density * (half + sqrt(half * half + m->sound_speed * m->sound_speed)) * v * m->bore_area;
}

double shot_hold_force(const shot_model *m, double I)
{
    return 2.0 * m->armature.friction_dry * (m->armature.preload + m->armature.spreading * I * I);
}

int shot_unknowns(const shot_model *m)
{
    return 2 * m->n + Y_COUNT + 2 * m->rails.ladder.n;
}

static double rails_current(const shot_model *m, const double *y)
{
    double I = 0.0;
    for (int k = 0; k < m->n; k++) {
        if (shot_group_conducts(&m->groups[k])) I += m->groups[k].n * y[2 * k + 1];
    }
    return I;
}

/* The loop the bank looks into ends at the armature, or at the muzzle's shunt once it has left. */
static double loop_length(const shot_model *m, const double *z)
{
    return m->phase == SHOT_LEFT ? m->barrel.length : z[Y_X];
}

static double loop_speed(const shot_model *m, const double *z)
{
    return m->phase == SHOT_MOVING ? fmax(z[Y_V], 0.0) : 0.0;
}

rails_flow shot_rails_flow(const shot_model *m, const double *y)
{
    const double *z = tail(m, y);
    return rails_flow_at(&m->rails, loop_length(m, z), loop_speed(m, z), rails_current(m, y), z + Y_COUNT);
}

double shot_push(const shot_model *m, double v, double I)
{
    return 0.5 * rails_force_gradient(&m->rails, fmax(v, 0.0)) * I * I;
}

/* m dv/dt = F - 2 mu(v) N - drag,  N = preload + k I^2                                     (C-3) */
shot_forces shot_forces_at(const shot_model *m, const double *y)
{
    shot_forces f = { 0 };
    const double v = tail(m, y)[Y_V];
    const bool left = m->phase == SHOT_LEFT;
    f.I = rails_current(m, y);
    f.R = left ? m->barrel.muzzle_resistance : m->armature.resistance;
    f.drop = left ? m->barrel.muzzle_voltage : m->armature.contact_voltage;
    if (left) return f;
    f.force = shot_push(m, v, f.I);
    f.contact = m->armature.preload + m->armature.spreading * f.I * f.I;
    f.mu = friction_coefficient(&m->armature, v);
    if (m->phase == SHOT_HELD) {
        f.friction = fmin(f.force, shot_hold_force(m, f.I));
        return f;
    }
    f.friction = 2.0 * f.mu * f.contact;
    f.drag = gas_drag(m, v);
    f.net = f.force - f.friction - f.drag;
    return f;
}

/* All branches in parallel, V = L_r dI/dt + V_r + R I + V_c with dI/dt = sum n (u - R_k i - V)/L_k:
 * V (1 + L_r sum n/L_k) = L_r sum n (u - R_k i)/L_k + V_r + R I + V_c                      (C-1) */
double shot_breech_voltage(const shot_model *m, const double *y)
{
    const shot_forces f = shot_forces_at(m, y);
    double push = 0.0, share = 0.0;
    for (int k = 0; k < m->n; k++) {
        const shot_group *g = &m->groups[k];
        if (!shot_group_conducts(g)) continue;
        push += g->n * (shot_group_voltage(g, y[2 * k]) - g->R * y[2 * k + 1]) / g->L;
        share += g->n / g->L;
    }
    if (share == 0.0) return 0.0;
    const rails_flow rails = shot_rails_flow(m, y);
    return (rails.inductance * push + rails.voltage + f.R * f.I + f.drop) / (1.0 + rails.inductance * share);
}

static void group_rates(const shot_group *g, const double *y, double V, double *d)
{
    const double u = shot_group_voltage(g, y[0]), i = y[1];
    d[0] = d[1] = 0.0;
    if (!shot_group_conducts(g)) return;
    d[1] = (u - g->R * i - V) / g->L;
    if (g->mode == GROUP_ON) {
        d[0] = -i / g->p.capacitance;
    } else { /* R_d C di_D/dt = i - i_D; algebraic, i_D = i, for an ideal diode */
        const double tau = g->p.crowbar_resistance * g->p.capacitance;
        d[0] = tau > 0.0 ? (i - y[0]) / tau : i;
    }
}

static void heat_rates(const shot_model *m, const double *y, double *q)
{
    for (int k = 0; k < m->n; k++) {
        const shot_group *g = &m->groups[k];
        if (!shot_group_conducts(g)) continue;
        const double i2 = g->n * y[2 * k + 1] * y[2 * k + 1];
        q[Y_COIL] += g->p.resistance * i2;
        q[Y_CABLE] += g->p.cable_resistance * i2;
        if (g->mode == GROUP_CROWBAR)
            q[Y_CROWBAR] += g->n * y[2 * k] * (g->p.crowbar_drop + g->p.crowbar_resistance * y[2 * k]);
    }
}

static void armature_rates(const shot_model *m, const double *z, const shot_forces *f, double *q)
{
    const double I = f->I, v = m->phase == SHOT_MOVING ? z[Y_V] : 0.0;
    q[Y_ARMATURE] = m->armature.resistance * I * I;
    q[Y_CONTACT] = m->armature.contact_voltage * I;
    if (m->phase != SHOT_MOVING) return;
    q[Y_X] = v;
    q[Y_V] = f->net / z[Y_MASS];
    q[Y_FRICTION] = f->friction * v;
    q[Y_DRAG] = f->drag * v;
    const double wear = m->armature.wear_fraction * (q[Y_FRICTION] + q[Y_CONTACT]) / m->wear_heat;
    q[Y_MASS] = -wear;
    q[Y_WEAR] = 0.5 * wear * v * v; /* melt leaves at the armature's speed and takes its motion along */
}

void shot_rates(const shot_model *m, const double *y, double *d)
{
    const double *z = tail(m, y);
    double *q = d + 2 * m->n;
    const shot_forces f = shot_forces_at(m, y);
    for (int j = 0; j < Y_COUNT; j++) q[j] = 0.0;
    for (int k = 0; k < m->n; k++) group_rates(&m->groups[k], y + 2 * k, z[Y_BREECH], d + 2 * k);
    heat_rates(m, y, q);
    q[Y_BREECH] = shot_breech_voltage(m, y);
    q[Y_ACTION] = f.I * f.I;
    q[Y_RAILS] = shot_rails_flow(m, y).heat;
    rails_memory_rates(&m->rails, loop_length(m, z), loop_speed(m, z), f.I, z + Y_COUNT, q + Y_COUNT);
    if (m->phase == SHOT_LEFT) {
        q[Y_MUZZLE] = (m->barrel.muzzle_resistance * f.I + m->barrel.muzzle_voltage) * f.I;
    } else {
        armature_rates(m, z, &f, q);
    }
}

bool shot_is_algebraic(const shot_model *m, int j)
{
    if (j == 2 * m->n + Y_BREECH) return true;
    if (j >= 2 * m->n || j % 2) return false;
    const shot_group *g = &m->groups[j / 2];
    return g->mode == GROUP_CROWBAR && g->p.crowbar_resistance == 0.0;
}

void shot_residual(const void *model, const double *y, const double *yp, double *r)
{
    const shot_model *m = model;
    const int n = shot_unknowns(m);
    shot_rates(m, y, r);
    for (int j = 0; j < n; j++) r[j] = (shot_is_algebraic(m, j) ? y[j] : yp[j]) - r[j];
    for (int k = 0; k < m->n; k++) { /* a stiff diode's row is scaled back by its time constant */
        const shot_group *g = &m->groups[k];
        if (g->mode == GROUP_CROWBAR && g->p.crowbar_resistance > 0.0)
            r[2 * k] *= g->p.crowbar_resistance * g->p.capacitance;
    }
}

static void group_roots(const shot_group *g, const double *y, double V, double *root)
{
    root[0] = root[1] = 1.0;
    if (g->mode == GROUP_WAITING) root[0] = y[0] - V;
    if (g->mode == GROUP_ON) root[0] = y[0] + g->p.crowbar_drop;
    if (shot_group_conducts(g)) root[1] = y[1];
}

void shot_roots(const void *model, const double *y, double *g)
{
    const shot_model *m = model;
    const double *z = tail(m, y);
    const bool moving = m->phase == SHOT_MOVING;
    g[ROOT_MOTION] = moving ? z[Y_V] : 1.0;
    g[ROOT_SITE] = moving && isfinite(m->next_site) ? z[Y_X] - m->next_site : 1.0;
    g[ROOT_MUZZLE] = moving ? z[Y_X] - m->barrel.length : 1.0;
    if (m->phase == SHOT_HELD) {
        const shot_forces f = shot_forces_at(m, y);
        g[ROOT_MOTION] = f.force - shot_hold_force(m, f.I) - RELEASE_MARGIN;
    }
    for (int k = 0; k < m->n; k++) group_roots(&m->groups[k], y + 2 * k, z[Y_BREECH], g + ROOT_GROUPS + 2 * k);
}
