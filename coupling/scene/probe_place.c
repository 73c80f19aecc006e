/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/probe_place.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LOOKS = 24 }; /* along each axis of the box that a probe and a body share */

typedef struct {
    const char *lower, *upper; /* the keys that give it; NULL: the probe has no place */
    double lo[3], hi[3];       /* [m] */
} place;

static place place_of(const mpm_scene *s, int probe)
{
    mpm_probe p = s->probe[probe];
    const double *at = mpm_probe_value(&p, "at"), *lo = mpm_probe_value(&p, "lo"), *hi = mpm_probe_value(&p, "hi");
    const double *reach = mpm_probe_value(&p, "reach");
    place is = { .lower = at ? "at" : lo && hi ? "lo" : NULL, .upper = at ? "at" : "hi" };
    for (int k = 0; is.lower && k < 3; k++) {
        const double half = reach && !isnan(*reach) ? *reach : 0.5 * s->axis[k].fine;
        is.lo[k] = at ? at[k] - half : lo[k];
        is.hi[k] = at ? at[k] + half : hi[k];
    }
    return is;
}

/* Of a probe that reads a cavity: is there one of that number? */
static status check_cavity(const mpm_scene *s, int probe)
{
    mpm_probe p = s->probe[probe];
    const double *number = strcmp(p.kind->name, "cavity") == 0 ? mpm_probe_value(&p, "number") : NULL;
    CHECK(!number || *number < s->cavities, STATUS_BAD_INPUT,
          "scene.probes[%d].cavity.number = %g: the scene has %d cavities, the first of which is 0", probe, *number,
          s->cavities);
    return status_ok();
}

status scene_probe_place_check(const mpm_scene *s, int probe)
{
    const mpm_probe *p = &s->probe[probe];
    const place is = place_of(s, probe);
    TRY(check_cavity(s, probe));
    for (int k = 0; is.lower && k < 3; k++) {
        const mpm_axis *a = &s->axis[k];
        const bool below = is.hi[k]<a->lo, above = is.lo[k]> a->hi;
        CHECK(!below && !above, STATUS_BAD_INPUT,
              "scene.probes[%d].%s.%s: %s lies at %s = %.4g .. %.4g m, beside the window, scene.window.%s = %.4g .. "
              "%.4g m: there will be nothing to read: move it, or widen the window",
              probe, p->kind->name, below ? is.upper : is.lower, p->name, mpm_axis_names[k], is.lo[k], is.hi[k],
              mpm_axis_names[k], a->lo, a->hi);
    }
    return status_ok();
}

/* Does the solid reach into the box, as far as the window holds both? */
static bool reaches(const mpm_scene *s, const mpm_solid *solid, const place *is)
{
    double lo[3], hi[3], h[3];
    mpm_solid_bounds(solid, lo, hi);
    for (int k = 0; k < 3; k++) {
        lo[k] = fmax(fmax(lo[k], is->lo[k]), s->axis[k].lo);
        h[k] = (fmin(fmin(hi[k], is->hi[k]), s->axis[k].hi) - lo[k]) / LOOKS;
        if (!(h[k] > 0.0)) return false;
    }
    for (int i = 0; i < LOOKS * LOOKS * LOOKS; i++) {
        const int at[3] = { i / (LOOKS * LOOKS), i / LOOKS % LOOKS, i % LOOKS };
        double x[3];
        for (int k = 0; k < 3; k++) x[k] = lo[k] + (at[k] + 0.5) * h[k];
        if (mpm_solid_inside(solid, x) > 0.0) return true;
    }
    return false;
}

bool scene_probe_is_empty(const mpm_scene *s, int probe, char text[400])
{
    const mpm_probe *p = &s->probe[probe];
    const place is = place_of(s, probe);
    if (!is.lower) return false;
    for (int i = 0; i < s->bodies; i++)
        if ((p->body < 0 || p->body == i) && reaches(s, &s->solid[s->body[i].solid], &is)) return false;
    snprintf(text, 400,
             "probe %.60s: nothing%s%.60s is where it reads at the start: it has no value until something comes there",
             p->name, p->body < 0 ? "" : " of ", p->body < 0 ? "" : s->body[p->body].name);
    return true;
}
