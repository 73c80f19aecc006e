/* The scene store: one HDF5 file a scene, in one folder, named by the scene's key.
 *
 * DIR/<key>.h5 appears at once or not at all, complete; whoever computes the same scene writes the same file.  So any
 * number of programs may share a folder, and what is killed loses the scene it was in.
 *   /            attributes: format, version, instruction_set, solver, case (the key's text: a case file of this
 *   scene),
 *                outcome (JSON, an entry of `scenes` of summary.json), impulse_N_s, mass_loss_kg
 *   /scene       its time series and crater, as in history.h5 (only what was recorded)
 * Of a scene of bodies the text is a dataset, /case, and the outcome lies by the series, /scene/result.
 * A file that is damaged or of another scene (a hash met twice) counts as none and is replaced. */
#ifndef BREECH_COUPLING_STORE_H
#define BREECH_COUPLING_STORE_H

#include "coupling/host/hdf5_file.h"
#include "coupling/run/scene_key.h"
#include "coupling/run/session.h"

/* The file of a scene in memory; its series are taken from h where h has them (NULL: none).  host_h5_close it. */
status run_scene_file_make(const scene_record *r, const scene_key *key, history *h, h5_file **out);
/* What it says: result, impulse, mass_loss; out->key is key->hash, the rest of the entry is left alone.  Of a scene of
 * bodies the result stays with the series.
 * STATUS_IO: not the file of this scene. */
status run_scene_file_read(const h5_file *f, const scene_key *key, scene_record *out);

/* Makes the folder.  dir: borrowed for the call. */
status run_store_open(const char *dir);
/* *out is NULL when there is none; run_scene_file_read has the last word. */
status run_store_get(const char *dir, const scene_key *key, h5_file **out);
bool run_store_has(const char *dir, const scene_key *key);
status run_store_put(const char *dir, const scene_key *key, h5_file *file);

#endif
