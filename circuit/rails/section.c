/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/section.h"

#include <math.h>

/* Radius of a circular arc of chord h and sagitta c. */
static double radius(double h, double c)
{
    return c > 0.0 ? (0.25 * h * h + c * c) / (2.0 * c) : INFINITY;
}

/* Distance of the arc from the line through its apex. */
static double arc(double h, double c, double y)
{
    if (c <= 0.0) return 0.0;
    const double r = radius(h, c);
    return y * y / (r + sqrt(fmax(r * r - y * y, 0.0)));
}

double circuit_section_face(const circuit_rail_section *s, double y)
{
    return 0.5 * s->separation + arc(s->height, s->face_crown, y);
}

double circuit_section_back(const circuit_rail_section *s, double y)
{
    return 0.5 * s->separation + s->thickness - arc(s->height, s->back_crown, y);
}

/* Below an arc of radius r, from its apex to the chord h. */
static double lost_area(double h, double c)
{
    if (c <= 0.0) return 0.0;
    const double r = radius(h, c), half = asin(fmin(0.5 * h / r, 1.0));
    return h * c - r * r * (half - 0.5 * sin(2.0 * half));
}

double circuit_section_metal_area(const circuit_rail_section *s)
{
    return s->height * s->thickness - lost_area(s->height, s->face_crown) - lost_area(s->height, s->back_crown);
}

double circuit_section_resistance(const circuit_rail_section *s)
{
    const double clad = s->cladding * s->height, metal = circuit_section_metal_area(s) - clad;
    const double conductance = metal / s->resistivity + (clad > 0.0 ? clad / s->cladding_resistivity : 0.0);
    return 4.0 / (s->rails * conductance);
}

status circuit_section_check(const circuit_rail_section *s)
{
    const double h = s->height, w = s->thickness, edge = w - s->face_crown - s->back_crown;
    CHECK(h > 0.0 && w > 0.0 && s->separation > 0.0, STATUS_BAD_INPUT,
          "rail.height = %g m, rail.thickness = %g m, rail.separation = %g m: all must be positive", h, w,
          s->separation);
    CHECK(s->face_crown >= 0.0 && s->face_crown <= 0.5 * h, STATUS_BAD_INPUT,
          "rail.face_crown = %g m: must be from 0 to half of rail.height, %g m", s->face_crown, 0.5 * h);
    CHECK(s->back_crown >= 0.0 && s->back_crown <= 0.5 * h, STATUS_BAD_INPUT,
          "rail.back_crown = %g m: must be from 0 to half of rail.height, %g m", s->back_crown, 0.5 * h);
    CHECK(edge >= -1e-12 * w, STATUS_BAD_INPUT,
          "rail.face_crown + rail.back_crown = %g m: must be at most rail.thickness, %g m",
          s->face_crown + s->back_crown, w);
    CHECK(s->cladding == 0.0 || (s->cladding > 0.0 && s->cladding < edge), STATUS_BAD_INPUT,
          "rail.cladding = %g m: must be 0 or less than the rail's thickness at its edge, %g m", s->cladding, edge);
    CHECK(s->resistivity > 0.0 && isfinite(s->resistivity), STATUS_BAD_INPUT,
          "rail.resistivity = %g ohm m: must be positive and finite", s->resistivity);
    CHECK(s->cladding == 0.0 || (s->cladding_resistivity > 0.0 && isfinite(s->cladding_resistivity)), STATUS_BAD_INPUT,
          "rail.cladding_resistivity = %g ohm m: must be positive and finite", s->cladding_resistivity);
    CHECK(s->rails == 2 || s->rails == 4, STATUS_BAD_INPUT, "rail.count = %d: must be 2 or 4", s->rails);
    CHECK(s->rails == 2 || circuit_section_face(s, 0.5 * h) > 0.5 * h, STATUS_BAD_INPUT,
          "four rails of height %g m, %g m apart, overlap: rail.height must be less than the bore at their edges", h,
          s->separation);
    return status_ok();
}

/* The line below y. */
static double row_end(double y, double size, double r, double step)
{
    if (isinf(r)) return y - size;
    return fmax(y - size, r * sin(asin(fmin(y / r, 1.0)) - step));
}

int circuit_section_rows(const circuit_rail_section *s, double first, double growth, double step, double *y)
{
    const double half = 0.5 * s->height, r = radius(s->height, fmax(s->face_crown, s->back_crown));
    double size = first;
    int n = 0;
    for (y[0] = half; y[n] > 1e-9 * half; size *= growth, n++) {
        if (n == CIRCUIT_SECTION_MAX_ROWS) return 0;
        y[n + 1] = row_end(y[n], size, r, step);
    }
    const double stretch = half / (half - y[n]);
    for (int k = 1; k <= n; k++) y[k] = half - (half - y[k]) * stretch;
    y[n] = 0.0;
    return n;
}

int circuit_section_images(const circuit_rail_section *s)
{
    return 2 * s->rails;
}

circuit_section_point circuit_section_image(circuit_section_point p, int image)
{
    if (image & 4) p = (circuit_section_point){ p.y, p.x };
    return (circuit_section_point){ image & 1 ? -p.x : p.x, image & 2 ? -p.y : p.y };
}

double circuit_section_image_sign(const circuit_rail_section *s, int image)
{
    if (s->rails == 4) return image & 4 ? -1.0 : 1.0;
    return image & 1 ? -1.0 : 1.0;
}

double circuit_section_weight(const circuit_rail_section *s)
{
    return s->rails == 4 ? 0.5 : 1.0;
}
