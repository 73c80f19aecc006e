/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_bodies.h"

static const summary_key body_keys[] = {
    SUMMARY_TEXT(scene_body, "name", name, "of the body"),
    SUMMARY_NUMBER(scene_body, "mass", mass, "kg", "in the window at the end"),
    SUMMARY_VECTOR(scene_body, "position", position, 3, "m", "mean over its mass"),
    SUMMARY_VECTOR(scene_body, "velocity", velocity, 3, "m/s", "mean over its mass"),
    SUMMARY_VECTOR(scene_body, "lo", lo, 3, "m", "lower ends of its intact material, null: there is none"),
    SUMMARY_VECTOR(scene_body, "hi", hi, 3, "m", "upper ends of it"),
    SUMMARY_NUMBER(scene_body, "kinetic", kinetic, "J", "energy of its motion"),
    SUMMARY_NUMBER(scene_body, "internal", internal, "J", "work of stress and heat"),
    SUMMARY_NUMBER(scene_body, "failed_volume", failed_volume, "m3", "that has failed"),
    SUMMARY_NUMBER(scene_body, "peak_pressure", peak_pressure, "Pa",
                   "that a thousandth of its mass had at once, of intact points"),
    SUMMARY_NUMBER(scene_body, "max_pressure", max_pressure, "Pa",
                   "of any intact point at any time: molten debris may set it"),
    SUMMARY_NUMBER(scene_body, "peak_mises", peak_mises, "Pa", "von Mises stress of any point at any time"),
    SUMMARY_END,
};

const summary_key scene_bodies_keys[] = {
    SUMMARY_NUMBER(scene_bodies_result, "end_time", end_time, "s", "simulated"),
    SUMMARY_NUMBER(scene_bodies_result, "peak_pressure", peak_pressure, "Pa", "the largest of the bodies'"),
    SUMMARY_NUMBER(scene_bodies_result, "max_pressure", max_pressure, "Pa",
                   "of any intact point at any time: molten debris may set it"),
    SUMMARY_NUMBER(scene_bodies_result, "peak_temperature", peak_temperature, "K",
                   "of any intact point at any time: a molten splinter may set it"),
    SUMMARY_NUMBER(scene_bodies_result, "kinetic", kinetic, "J", "energy of motion at the end, as computed"),
    SUMMARY_NUMBER(scene_bodies_result, "internal", internal, "J", "work of stress and heat, as computed"),
    SUMMARY_NUMBER(scene_bodies_result, "heat_friction", heat_friction, "J", "part of internal"),
    SUMMARY_NUMBER(scene_bodies_result, "work_boundary", work_boundary, "J", "done on the model by its boundaries"),
    SUMMARY_NUMBER(scene_bodies_result, "work_external", work_external, "J", "done on it by tractions and body forces"),
    SUMMARY_NUMBER(scene_bodies_result, "ejected_mass", ejected_mass, "kg", "that left the window or was eroded"),
    SUMMARY_NUMBER(scene_bodies_result, "eroded_mass", eroded_mass, "kg", "dust taken out"),
    SUMMARY_NUMBER(scene_bodies_result, "momentum_error", momentum_error, "1",
                   "over mass times the largest initial speed"),
    SUMMARY_NUMBER(scene_bodies_result, "energy_error", energy_error, "1",
                   "over the kinetic energy the scene starts with"),
    SUMMARY_MAP(scene_bodies_result, "bodies", body, bodies, body_keys, sizeof(scene_body), "each by its name"),
    SUMMARY_MAP(scene_bodies_result, "probes", probe, probes, scene_probe_keys, sizeof(scene_probe_result),
                "each by its name"),
#define WORK(member, text) SUMMARY_VALUE(scene_bodies_result, KEY_COUNT, #member, member, "1", text),
#include "coupling/scene/scene_work.def"
    SUMMARY_NUMBER(scene_bodies_result, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_VALUE(scene_bodies_result, KEY_INTEGER, "threads", threads, "1",
                  "of its process; others may have lent theirs"),
    SUMMARY_END,
};
