/* SPDX-License-Identifier: BSD-3-Clause */
/* breech inductance: L' and R' of a pair of rails over frequency, and where the current runs. */
#include "coupling/study/study.h"
#include "base/constants.h"
#include "circuit/rails/inductance.h"
#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/study/inductance.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

static const summary_key keys[] = {
    SUMMARY_ARRAY(inductance_result, "frequency", frequency, n, "Hz", ""),
    SUMMARY_ARRAY(inductance_result, "L_gradient", L_gradient, n, "H/m", "of the pair, over frequency"),
    SUMMARY_ARRAY(inductance_result, "R_gradient", R_gradient, n, "ohm/m", "of the pair, over frequency"),
    SUMMARY_NUMBER(inductance_result, "L_gradient_high_frequency", L_gradient_high_frequency, "H/m", "limit"),
    SUMMARY_NUMBER(inductance_result, "L_gradient_direct_current", L_gradient_direct_current, "H/m", "limit"),
    SUMMARY_NUMBER(inductance_result, "R_gradient_direct_current", R_gradient_direct_current, "ohm/m", "limit"),
    SUMMARY_NUMBER(inductance_result, "L_gradient_kerrisk", L_gradient_kerrisk, "H/m",
                   "Kerrisk's formula for the high-frequency limit; null: not two flat rails"),
    SUMMARY_NUMBER(inductance_result, "kerrisk_error", kerrisk_error, "1",
                   "of that formula, over L_gradient_high_frequency"),
    SUMMARY_NUMBER(inductance_result, "perimeter_frequency", perimeter_frequency, "Hz", "of the three that follow"),
    SUMMARY_ARRAY(inductance_result, "perimeter", perimeter, n_perimeter, "m",
                  "along the surface, middle of the bore face to middle of the back"),
    SUMMARY_ARRAY(inductance_result, "perimeter_current", perimeter_current, n_perimeter, "1/m2",
                  "current density there over the rail's current"),
    SUMMARY_ARRAY(inductance_result, "perimeter_heat", perimeter_heat, n_perimeter, "ohm/m3",
                  "heating there over the rail's current squared, W/m3 per A2"),
    SUMMARY_END
};

typedef struct {
    inductance_result result;   /* borrows the rest */
    double *gradients;          /* owned */
    inductance_surface surface; /* owned */
} inductance_answer;

static void answer_free(void *owned)
{
    inductance_answer *a = owned;
    if (!a) return;
    free(a->gradients);
    circuit_inductance_surface_free(&a->surface);
    free(a);
}

static const double frequencies[] = { 1, 2, 5, 10, 20, 50, 100, 200, 500, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5 };
enum { FREQUENCIES = sizeof frequencies / sizeof frequencies[0] };

/* All frequencies from one solution, the perfect conductor from another. */
static status gradients_fill(const circuit_shot_rails *rails, inductance_answer *out)
{
    inductance_result *r = &out->result;
    circuit_rail_section section;
    circuit_impedance z;
    TRY(circuit_rails_section(rails, &section));
    status done = circuit_inductance_response(&section, frequencies[FREQUENCIES - 1], rails->fineness, &z);
    for (int i = 0; i < FREQUENCIES && done.code == STATUS_OK; i++) {
        const double omega = 2.0 * PI * frequencies[i];
        const double complex Z = circuit_impedance_at(&z, _Complex_I * omega);
        out->gradients[i] = cimag(Z) / omega;
        out->gradients[FREQUENCIES + i] = creal(Z);
    }
    circuit_impedance_free(&z);
    TRY(done);
    TRY(circuit_inductance_at(&section, 0.0, rails->fineness, &r->L_gradient_direct_current,
                              &r->R_gradient_direct_current));
    TRY(circuit_inductance_limit(&section, &r->L_gradient_high_frequency));
    const bool flat = section.rails == 2 && section.face_crown == 0.0 && section.back_crown == 0.0;
    r->L_gradient_kerrisk =
        flat ? circuit_inductance_kerrisk(section.height, section.thickness, section.separation) : NAN;
    r->kerrisk_error = r->L_gradient_kerrisk / r->L_gradient_high_frequency - 1.0;
    return circuit_inductance_surface_at(&section, r->perimeter_frequency, rails->fineness, &out->surface);
}

/* The surface at rails.frequency; else at what the pulse says, at 1 kHz without supplies. */
static double surface_frequency(const circuit_shot_config *launcher)
{
    if (!isnan(launcher->rails.frequency)) return launcher->rails.frequency;
    const double f = circuit_shot_effective_frequency(launcher);
    return isnan(f) ? 1000.0 : f;
}

static status run(session *s, const study_case *of, study_answer *out)
{
    const double since = host_wall_clock();
    const circuit_shot_config *launcher = &of->in->onset.launcher;
    inductance_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    inductance_result *r = &a->result;
    a->gradients = malloc(2 * FREQUENCIES * sizeof *a->gradients);
    CHECK(a->gradients, STATUS_MEMORY, "no memory for %d frequencies", FREQUENCIES);
    host_progress_task(&s->progress, "inductance gradients", 0.0, 0);
    *r = (inductance_result){ .n = FREQUENCIES,
                              .frequency = frequencies,
                              .L_gradient = a->gradients,
                              .R_gradient = a->gradients + FREQUENCIES,
                              .perimeter_frequency = surface_frequency(launcher) };
    TRY(gradients_fill(&launcher->rails, a));
    r->n_perimeter = a->surface.n;
    r->perimeter = a->surface.place;
    r->perimeter_current = a->surface.current;
    r->perimeter_heat = a->surface.heating;
    out->result = r;
    host_timing_add(&s->timing, "inductance", host_wall_clock() - since);
    return status_ok();
}

static void print(const void *result, FILE *out)
{
    const inductance_result *r = result;
    table *t;
    output_keys_print(&(summary_object){ keys, r }, out);
    if (host_table_create("f [Hz]|L' [uH/m]|R' [mohm/m]", &t).code != STATUS_OK) return;
    for (int i = 0; i < r->n; i++)
        host_table_row(t, "%.4g|%.4f|%.5g", r->frequency[i], 1e6 * r->L_gradient[i], 1e3 * r->R_gradient[i]);
    host_table_print(t, out);
    host_table_free(t);
}

const study study_inductance = {
    .name = "inductance",
    .doc = "L', R' of a rail cross-section, over frequency",
    .more = "Needs the section rail.  Direct current, 1 Hz to 100 kHz, the perfect conductor; the surface at "
            "rail.frequency.",
    .example = "breech inductance cases/default_shot --set \"rail.thickness=15 mm\" -o out/thin",
    .needs = CASE_FOR_INDUCTANCE,
    .keys = keys,
    .can_vary = true,
    .report = { report_inductance_head, report_inductance_section },
    .print = print,
    .run = run,
    .free = answer_free,
};
