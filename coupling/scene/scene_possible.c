/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_possible.h"

#include "coupling/case/case_plain.h"

status scene_possible(const mpm_scene *s)
{
    mpm_refused at;
    char text[480];
    const status made = mpm_check_made(s, 0, &at);
    if (made.code != STATUS_BAD_INPUT) return made;
    case_refused_text(&at, made.text, text, sizeof text);
    return base_status_error(STATUS_BAD_INPUT, "%s", text);
}
