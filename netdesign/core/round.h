/* Parts of a round of flow and net. */
#ifndef NETDESIGN_ROUND_H
#define NETDESIGN_ROUND_H

#include "element.h"

/* What the core is given to place a mesh, and where it puts the results. */
typedef struct {
    int32_t n_nodes, n_triangles, n_net;
    const int32_t *triangles, *net; /* (n_triangles, 6), (n_net,) */
    const double *orientation;      /* (n_triangles,): 1 or -1 */
    const double *reference;        /* (6, 2, 3): gradients of shape functions */
    const double *shape;            /* (3, 6) */
    const double *point_weights;    /* (3,) */
    const double *edge_tangent;     /* (3, 3): node, coefficient of an edge's node */
    const double *nodes;            /* (2, n_nodes) */
    double *gradients, *weights;    /* (2, n_triangles, 3, 6), (n_triangles, 3) */
    double *load, *axes, *normal;   /* (n_nodes,), (2, n_nodes), (2, n_net) */
} Placement;

/* An iterate of the flow: where it starts, and where it ends. */
typedef struct {
    double *numbers; /* unknowns, reactions (2 n_nodes,), stress, then shear if any */
    Contact contact; /* under which it was found */
    int32_t slides;
} State;

/* What is asked of a flow, and what it took. */
typedef struct {
    double tolerance, linear_part, square_factor, field_weight; /* as in snow/flow.py */
    int32_t most_steps, patience;
    int32_t steps; /* taken, with the first */
    double change; /* that the last one left */
} Effort;

/* What keeps a round from its end, as in coupling/steady/compiled.py: no mesh along the
 * curve; a flow that does not end, or not with numbers; a net without equilibrium, or
 * whose parts in layers and above the snow are not found. */
enum { OFF_MESH = 1, GAVE_UP, NOT_FINITE, OPEN, UNPARTED };

void place_mesh(const Placement *to);
int solve_flow(const Mesh *mesh, const Law *law, const Law *first, const Rules *rules,
               const int32_t *plan, const State *state, Effort *effort);
int hang_cable(int32_t n, const double *forces, const double *lengths, double stiffness,
               const double *head, double tolerance, double *pull, double *curve,
               double *tension, double *ends);
int part_cable(int32_t n, int32_t n_parts, const double *forces, const double *shares,
               const int64_t *firsts, const double *rises, double head_x, double length,
               double stiffness, double *pull, double *lengths);

#endif
