/* The main job: where along the rail does gouging begin?
 *
 *   shot -> every site's state at arrival -> screen -> for each family of grains (family.h) the threshold velocity over
 *   size, by scenes -> what else its interval has to hold (uncertain.h) -> sites judged -> what further shots find
 *   (repeated.h) -> populations drawn (montecarlo.h) -> gouges handed back to the shot.
 * A site at v gouges from its interval's upper end on, does not up to its lower end, and is undecided between.
 * `breech compare` does the same for several surfaces with study_onset_begin and study_onset_judge. */
#ifndef BREECH_COUPLING_ONSET_H
#define BREECH_COUPLING_ONSET_H

#include "coupling/study/repeated.h"
#include "coupling/study/search/uncertain.h"

typedef struct {
    onset_result result; /* borrows the arrays below */
    shot_record shot;
    shot_outcome flown;         /* owned */
    grain_families grains;      /* owned; borrows flown, so an answer stays where it is */
    uncertain_inputs uncertain; /* owned, borrows grains */
    repeated_rail rail;         /* of the shots after the first; owned, borrows grains */
    mc_result drawn;            /* owned */
    onset_site *site;           /* owned, as all that follows */
    onset_scene *scene;
    onset_size *size;
    onset_skip *skip;
    onset_sensitivity *sensitivity;
    onset_shot *repeated;
    double *along;
} onset_answer;

/* *out needs study_onset_answer_free even on error; what was reached by then is in it. */
status study_onset_run(session *s, onset_answer *out);
void study_onset_answer_free(onset_answer *a);

/* The shot of a case, its sites and families; c may be the session's case under a treatment, prefix names its scenes.
 */
status study_onset_begin(session *s, const breech_case *c, const char *prefix, onset_answer *out);

/* After study_families_search: every site's outcome, verdict, threshold. */
status study_onset_judge(session *s, onset_answer *a);

/* The grain that speaks for the case: of the median size of the first population with a family, else the onset's site,
 * else the one with the lowest threshold.  NULL: there is none. */
const grain_family *study_onset_leading_grain(const onset_answer *a, double *radius);

/* The scenes of the session, as a summary lists them, and what is to be warned of in them; *n of them, the caller
 * frees. */
status study_onset_list_scenes(session *s, onset_scene **out, int *n, int *run, int *reused);

#endif
