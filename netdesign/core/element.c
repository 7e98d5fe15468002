/* Laws at the points of triangles and of edges on the ground; blocks and nodal forces.
 *
 * The kernels of snow/law.py and snow/kernel.py. Theory: snow/THEORY.md, (N8) to (N12). */
#include "element.h"

#include <math.h>
#include <string.h>

/* S^2 of (N8), M^-1 written out. */
double squared_invariant(const double *stress, double bulk) {
    double coupling = bulk - 2.0 / 3.0, trace = stress[0] + stress[1];
    return (stress[0] * stress[0] + stress[1] * stress[1]) / 2.0 + stress[2] * stress[2]
           - coupling / (4.0 * (1.0 + coupling)) * (trace * trace);
}

/* Viscosity (S^2 + s0^2)^((1-n)/2), q of (N9), and 1 / (1 + q S^2). */
static void find_scalars(double exponent, double floor, double size, double *viscosity,
                         double *reduction, double *share) {
    double floored = size + floor * floor;
    *reduction = (exponent - 1.0) / floored;
    *share = 1.0 / (1.0 + *reduction * size);
    if (exponent == 3.0) *viscosity = 1.0 / floored;
    else if (exponent == 1.0) *viscosity = 1.0;
    else *viscosity = pow(floored, (1.0 - exponent) / 2.0);
}

/* Tangent at a point, (N9) and (N10). */
static void linearise_point(const Law *law, double bulk, double fluidity,
                            const double *s, double *moduli, double *rest) {
    double viscosity, reduction, share, coupling = bulk - 2.0 / 3.0;
    find_scalars(law->exponent, law->floor, squared_invariant(s, bulk), &viscosity,
                 &reduction, &share);
    double v = viscosity / fluidity, q = reduction * share;
    moduli[0] = v * (2.0 + coupling - q * (s[0] * s[0]));
    moduli[1] = v * (coupling - q * (s[0] * s[1]));
    moduli[2] = -v * (q * (s[0] * s[2]));
    moduli[3] = v * (2.0 + coupling - q * (s[1] * s[1]));
    moduli[4] = -v * (q * (s[1] * s[2]));
    moduli[5] = v * (1.0 - q * (s[2] * s[2]));
    for (int i = 0; i < PLANE; i++) rest[i] = s[i] * (1.0 - share);
}

/* Laws about the stresses of a step. */
void linearise(const Mesh *mesh, const Law *law, const Step *step,
               const uint8_t *bears, const Tangents *to) {
    for (int32_t i = 0; i < POINTS * mesh->n_triangles; i++)
        linearise_point(law, law->bulk[i * law->stride], law->fluidity[i * law->stride],
                        step->stress + PLANE * i, to->moduli + MODULI * i,
                        to->intercept + PLANE * i);
    for (int32_t i = 0; step->shear && i < EDGE_POINTS * mesh->n_edges; i++) {
        double viscosity, reduction, share, shear = step->shear[i];
        double carries = bears[i / EDGE_POINTS] ? 1.0 : 0.0;
        find_scalars(law->slip_exponent, law->floor, shear * shear, &viscosity,
                     &reduction, &share);
        double slip = law->slip[i / EDGE_POINTS * law->slip_stride];
        to->base_moduli[i] = carries * (viscosity * share / slip);
        to->base_intercept[i] = carries * (shear * (1.0 - share));
    }
}

/* The axes of some node of a triangle are turned. */
static int is_turned(const Mesh *mesh, const int32_t *nodes) {
    for (int k = 0; k < TRIANGLE; k++)
        if (mesh->axes[nodes[k]] != 1.0 || mesh->axes[mesh->n_nodes + nodes[k]] != 0.0)
            return 1;
    return 0;
}

/* From the slope's axes to node axes, or back: pairs ``step`` apart. */
static void turn(const Mesh *mesh, const int32_t *nodes, double *values, int step,
                 double sense) {
    for (int k = 0; k < TRIANGLE; k++) {
        double c = mesh->axes[nodes[k]];
        double s = sense * mesh->axes[mesh->n_nodes + nodes[k]];
        double x = values[2 * k * step], y = values[(2 * k + 1) * step];
        values[2 * k * step] = c * x + s * y;
        values[(2 * k + 1) * step] = c * y - s * x;
    }
}

/* Stresses of unit velocities at a point times its weight, (3, 12). */
WIDE static void weigh_strains(const Mesh *mesh, const double *moduli, int32_t point,
                          double *to) {
    const double *dx = mesh->gradients + (ptrdiff_t)TRIANGLE * point;
    const double *dy = dx + (ptrdiff_t)TRIANGLE * POINTS * mesh->n_triangles;
    const double *m = moduli + (ptrdiff_t)MODULI * point;
    double w = mesh->weights[point];
    for (int k = 0; k < TRIANGLE; k++) {
        double x = w * dx[k], y = w * dy[k];
        to[2 * k] = m[0] * x + m[2] * y;
        to[2 * k + 1] = m[1] * y + m[2] * x;
        to[UNKNOWNS + 2 * k] = m[1] * x + m[4] * y;
        to[UNKNOWNS + 2 * k + 1] = m[3] * y + m[4] * x;
        to[2 * UNKNOWNS + 2 * k] = m[2] * x + m[5] * y;
        to[2 * UNKNOWNS + 2 * k + 1] = m[4] * y + m[5] * x;
    }
}

WIDE static void fill_block(const Mesh *mesh, const double *moduli, int32_t triangle,
                       double *restrict block) {
    double strained[POINTS][PLANE * UNKNOWNS];
    memset(block, 0, UNKNOWNS * UNKNOWNS * sizeof *block);
    for (int q = 0; q < POINTS; q++) {
        int32_t point = POINTS * triangle + q;
        const double *dx = mesh->gradients + (ptrdiff_t)TRIANGLE * point;
        const double *dy = dx + (ptrdiff_t)TRIANGLE * POINTS * mesh->n_triangles;
        const double *xx = strained[q], *yy = xx + UNKNOWNS, *xy = yy + UNKNOWNS;
        weigh_strains(mesh, moduli, point, strained[q]);
        for (int k = 0; k < TRIANGLE; k++) {
            double *first = block + 2 * UNKNOWNS * k, x = dx[k], y = dy[k];
            double *second = first + UNKNOWNS;
            for (int c = 0; c < UNKNOWNS; c++) first[c] += x * xx[c] + y * xy[c];
            for (int c = 0; c < UNKNOWNS; c++) second[c] += y * yy[c] + x * xy[c];
        }
    }
    const int32_t *nodes = mesh->triangles + TRIANGLE * triangle;
    if (!is_turned(mesh, nodes)) return;
    for (int i = 0; i < UNKNOWNS; i++) turn(mesh, nodes, block + UNKNOWNS * i, 1, 1.0);
    for (int i = 0; i < UNKNOWNS; i++) turn(mesh, nodes, block + i, UNKNOWNS, 1.0);
}

/* Blocks (n_triangles, 12, 12), node axes; those of edges are in their triangles'. */
void fill_blocks(const Mesh *mesh, const Tangents *of, int slides, double *blocks) {
    for (int32_t t = 0; t < mesh->n_triangles; t++)
        fill_block(mesh, of->moduli, t, blocks + (ptrdiff_t)UNKNOWNS * UNKNOWNS * t);
    for (int32_t e = 0; slides && e < mesh->n_edges; e++) {
        const int32_t *edge = mesh->edges + 4 * e;
        double *block = blocks + (ptrdiff_t)UNKNOWNS * UNKNOWNS * edge[0];
        for (int q = 0; q < EDGE_POINTS; q++) {
            int32_t point = EDGE_POINTS * e + q;
            const double *shape = mesh->edge_shape + EDGE * q;
            double modulus = mesh->edge_weights[point] * of->base_moduli[point];
            for (int a = 0; a < EDGE; a++)
                for (int b = 0; b < EDGE; b++)
                    block[2 * UNKNOWNS * edge[1 + a] + 2 * edge[1 + b]] +=
                        modulus * shape[a] * shape[b];
        }
    }
}

/* Adds the nodal forces of stresses, and of shear on the ground, node axes. */
void add_forces(const Mesh *mesh, const double *stress, const double *shear,
                double *forces) {
    for (int32_t t = 0; t < mesh->n_triangles; t++) {
        const int32_t *nodes = mesh->triangles + TRIANGLE * t;
        double own[UNKNOWNS] = {0.0};
        for (int32_t i = POINTS * t; i < POINTS * (t + 1); i++) {
            const double *dx = mesh->gradients + (ptrdiff_t)TRIANGLE * i;
            const double *dy = dx + (ptrdiff_t)TRIANGLE * POINTS * mesh->n_triangles;
            double w = mesh->weights[i], xx = w * stress[PLANE * i];
            double yy = w * stress[PLANE * i + 1], xy = w * stress[PLANE * i + 2];
            for (int k = 0; k < TRIANGLE; k++) {
                own[2 * k] += dx[k] * xx + dy[k] * xy;
                own[2 * k + 1] += dy[k] * yy + dx[k] * xy;
            }
        }
        if (is_turned(mesh, nodes)) turn(mesh, nodes, own, 1, 1.0);
        for (int k = 0; k < TRIANGLE; k++) {
            forces[2 * nodes[k]] += own[2 * k];
            forces[2 * nodes[k] + 1] += own[2 * k + 1];
        }
    }
    for (int32_t i = 0; shear && i < EDGE_POINTS * mesh->n_edges; i++) {
        const int32_t *edge = mesh->edges + 4 * (i / EDGE_POINTS);
        const double *shape = mesh->edge_shape + EDGE * (i % EDGE_POINTS);
        for (int a = 0; a < EDGE; a++)
            forces[2 * mesh->triangles[TRIANGLE * edge[0] + edge[1 + a]]] +=
                mesh->edge_weights[i] * shear[i] * shape[a];
    }
}

static void fetch_velocities(const Mesh *mesh, const int32_t *nodes,
                             const double *unknowns, double *own) {
    for (int k = 0; k < TRIANGLE; k++) {
        own[2 * k] = unknowns[2 * nodes[k]];
        own[2 * k + 1] = unknowns[2 * nodes[k] + 1];
    }
    if (is_turned(mesh, nodes)) turn(mesh, nodes, own, 1, -1.0);
}

/* Stresses and shears after a step: intercept + modulus times strain. */
void advance(const Mesh *mesh, const Tangents *of, const Step *step) {
    for (int32_t t = 0; t < mesh->n_triangles; t++) {
        double own[UNKNOWNS];
        fetch_velocities(mesh, mesh->triangles + TRIANGLE * t, step->unknowns, own);
        for (int32_t i = POINTS * t; i < POINTS * (t + 1); i++) {
            const double *dx = mesh->gradients + (ptrdiff_t)TRIANGLE * i;
            const double *dy = dx + (ptrdiff_t)TRIANGLE * POINTS * mesh->n_triangles;
            const double *m = of->moduli + MODULI * i, *rest = of->intercept + PLANE * i;
            double xx = 0.0, yy = 0.0, xy = 0.0, *to = step->new_stress + PLANE * i;
            for (int k = 0; k < TRIANGLE; k++) {
                xx += dx[k] * own[2 * k];
                yy += dy[k] * own[2 * k + 1];
                xy += dy[k] * own[2 * k] + dx[k] * own[2 * k + 1];
            }
            to[0] = rest[0] + (m[0] * xx + m[1] * yy + m[2] * xy);
            to[1] = rest[1] + (m[1] * xx + m[3] * yy + m[4] * xy);
            to[2] = rest[2] + (m[2] * xx + m[4] * yy + m[5] * xy);
        }
    }
    for (int32_t i = 0; step->shear && i < EDGE_POINTS * mesh->n_edges; i++) {
        const int32_t *edge = mesh->edges + 4 * (i / EDGE_POINTS);
        const double *shape = mesh->edge_shape + EDGE * (i % EDGE_POINTS);
        double speed = 0.0;
        for (int a = 0; a < EDGE; a++)
            speed += shape[a] * step->unknowns[2 * mesh->triangles[TRIANGLE * edge[0]
                                                                   + edge[1 + a]]];
        step->new_shear[i] = of->base_intercept[i] + of->base_moduli[i] * speed;
    }
}
