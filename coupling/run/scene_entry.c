/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/scene_entry.h"

/* A scene of a study: what it was given; its result's keys follow in the same object. */
const summary_key run_scene_keys[] = {
    SUMMARY_TEXT(onset_scene, "name", name, "folder under scenes/, group under /scene of history.h5"),
    SUMMARY_NUMBER(onset_scene, "velocity", velocity, "m/s", "of the armature"),
    SUMMARY_NUMBER(onset_scene, "radius", radius, "m", "of the grain"),
    SUMMARY_NUMBER(onset_scene, "height", height, "m", "of the grain"),
    SUMMARY_TEXT(onset_scene, "shape", shape, "of the grain"),
    SUMMARY_TEXT(onset_scene, "material", material, "of the grain"),
    SUMMARY_TEXT(onset_scene, "surface", surface, "of the rail"),
    SUMMARY_NUMBER(onset_scene, "contact_pressure", contact_pressure, "Pa", "pressing the armature on"),
    SUMMARY_NUMBER(onset_scene, "temperature", temperature, "K", "of the rail"),
    SUMMARY_NUMBER(onset_scene, "lead_face_temperature", lead_face_temperature, "K", "of the armature, all of it"),
    SUMMARY_NUMBER(onset_scene, "cells_per_radius", cells_per_radius, "1", "resolution"),
    SUMMARY_VALUE(onset_scene, KEY_FLAG, "gauged", gauged, "",
                  "over once its groove's growth was known: its crater is as far as it was"),
    SUMMARY_VALUE(onset_scene, KEY_FLAG, "reused", reused, "", "not computed by this run"),
    SUMMARY_PART(onset_scene, "scene", result, run_result_keys),
    SUMMARY_END
};
