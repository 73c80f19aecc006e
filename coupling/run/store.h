/* SPDX-License-Identifier: BSD-3-Clause */
/* The scene store: a folder with one HDF5 file for each scene, named by the scene's key.
 *
 * DIR/<key>.h5 is written under another name and renamed, so a reader finds a complete file or none.  Every program
 * that computes a scene writes the same file for it.  So any number of programs may share a folder; a program that is
 * killed loses only the scene that it was computing.
 *   /            attributes: format, version, instruction_set, solver, case (the key's text: a case file of the scene),
 *                outcome (JSON, an entry of `scenes` of summary.json), impulse_N_s, mass_loss_kg
 *   /scene       the scene's time series and crater, as in history.h5 (only what was recorded)
 * For a scene of bodies the key's text is a dataset, /case, and the outcome is a text beside the series, /scene/result.
 * Behind the end of the HDF5 file stand 16 bytes more: a magic number and a hash over all bytes before them.  So a file
 * that was changed in any bit is noticed before anything of it is read.
 * A damaged file, or one of another scene with the same hash, is warned of, computed anew and replaced. */
#ifndef BREECH_COUPLING_STORE_H
#define BREECH_COUPLING_STORE_H

#include "coupling/host/hdf5_file.h"
#include "coupling/run/scene_key.h"
#include "coupling/run/session.h"

/* Makes a scene's file in memory, with the series that h has of it (NULL: none).  The caller closes it with
 * host_h5_close. */
status run_scene_file_make(const scene_record *r, const scene_key *key, history *h, h5_file **out);
/* Reads result, impulse and mass_loss into *out and sets out->key to key->hash; other members do not change.  For a
 * scene of bodies the result stays with the series.  STATUS_IO: the file is not of this scene. */
status run_scene_file_read(const h5_file *f, const scene_key *key, scene_record *out);

/* Before the first scene: makes the folder, tries whether it can be written to, removes what killed processes of this
 * machine have left half written. */
status run_store_open(const char *dir);
/* *out is NULL if the store has no such file.  STATUS_IO: it is damaged.  Only run_scene_file_read says whether it is
 * of this scene. */
status run_store_get(const char *dir, const scene_key *key, h5_file **out);
bool run_store_has(const char *dir, const scene_key *key);
/* Before the scene is computed: could run_store_put put it there?  STATUS_BAD_INPUT: a folder stands in its place. */
status run_store_check(const char *dir, const scene_key *key);
/* Makes the folder where there is none. */
status run_store_put(const char *dir, const scene_key *key, h5_file *file);

#endif
