/* The snow of a step of a history, condensed to the net's nodes.
 *
 * The kernels of addons/history/snow.py. Theory: core/THEORY.md, section 2. */
#include "round.h"

#include <math.h>
#include <string.h>

/* A body of snow where equilibrium is taken. Axes are the slope's everywhere. */
typedef struct {
    Placement place;
    Mesh mesh;
    Law law, first;           /* first: of an iterate without stresses */
    const int32_t *plan;
    const uint8_t *is_free;   /* (2 n_nodes,); the net's do not count */
    const double *edge_rule;  /* (4,): weights of the quadrature on an edge */
    double *edge_weights;     /* (n_edges, 4) */
    int32_t slides;           /* the ground has a shear */
} Body;

/* Iterate of the snow; the first has neither stress nor shear. */
typedef struct {
    double *unknowns;         /* (2 n_nodes,) */
    double *stress, *shear;   /* (n_triangles, 3, 3); (n_edges, 4), or NULL */
    double *imbalance;        /* (2 n_nodes,): internal forces less the weight */
    double change;            /* relative, of the stress */
} Iterate;

/* The mesh of nodes; gives whether no triangle of it is turned over. */
EXPORT int32_t nd_place(Body *body) {
    const Mesh *mesh = &body->mesh;
    place_mesh(&body->place);
    for (int32_t i = 1; i < mesh->n_net; i++) {
        body->place.axes[mesh->net[i]] = 1.0;
        body->place.axes[mesh->n_nodes + mesh->net[i]] = 0.0;
    }
    for (int32_t e = 0; e < mesh->n_edges; e++) {
        double start = body->place.nodes[mesh->ground[2 * e]];
        double half = fabs(body->place.nodes[mesh->ground[2 * e + 2]] - start) / 2.0;
        for (int q = 0; q < EDGE_POINTS; q++)
            body->edge_weights[EDGE_POINTS * e + q] = half * body->edge_rule[q];
    }
    for (int32_t i = 0; i < POINTS * mesh->n_triangles; i++)
        if (!(mesh->weights[i] > 0.0 && isfinite(mesh->weights[i]))) return 0;
    return 1;
}

/* Numbers that the memory of a step has. */
EXPORT int32_t nd_room(const Body *body) {
    Room room;
    size_t count = lay_room(&body->mesh, body->plan, NULL, &room);
    return count > 0 && count <= INT32_MAX ? (int32_t)count : BAD_INPUT;
}

/* Forces (2 n_net,) that are missing at the net's nodes once the other nodes of an
 * iterate have moved, and the root of section 2. */
EXPORT int32_t nd_condense(const Body *body, const Iterate *from, int64_t size,
                           double *memory, double *root, double *missing) {
    const Mesh *mesh = &body->mesh;
    Room room;
    if (lay_room(mesh, body->plan, NULL, &room) != (size_t)size) return BAD_INPUT;
    lay_room(mesh, body->plan, memory, &room);
    memcpy(room.is_free, body->is_free, 2 * (size_t)mesh->n_nodes);
    memset(room.bears, 1, (size_t)mesh->n_edges);
    const double *zeros = room.blocks; /* of stress and shear, until there are blocks */
    if (!from->stress || !from->shear)
        memset(room.blocks, 0, UNKNOWNS * UNKNOWNS * (size_t)mesh->n_triangles
                                   * sizeof *room.blocks);
    Step step = {.stress = from->stress ? from->stress : zeros, .moving = from->unknowns,
                 .shear = !body->slides ? NULL : from->shear ? from->shear : zeros};
    set_up(mesh, from->stress ? &body->law : &body->first, &step, &room);
    Factor to = {.plan = body->plan, .is_free = room.is_free, .factor = room.factor,
                 .load = room.load, .root = root};
    int fault = factor_fronts(&to, room.blocks, room.stack, room.work);
    for (int32_t i = 0; i < 2 * mesh->n_net; i++)
        missing[i] = room.load[2 * mesh->net[i / 2] + i % 2];
    return fault;
}

/* The iterate that follows from changes (2 n_net,) of the velocities of the net's nodes. */
EXPORT int32_t nd_answer(const Body *body, const Iterate *from, Iterate *to, int64_t size,
                         double *memory, const double *moved) {
    const Mesh *mesh = &body->mesh;
    Room room;
    if (lay_room(mesh, body->plan, NULL, &room) != (size_t)size) return BAD_INPUT;
    lay_room(mesh, body->plan, memory, &room);
    Factor of = {.plan = body->plan, .factor = room.factor, .load = room.load};
    for (int32_t i = 0; i < 2 * mesh->n_net; i++)
        room.load[2 * mesh->net[i / 2] + i % 2] = moved[i];
    solve_fronts(&of, room.work);
    for (int32_t i = 0; i < 2 * mesh->n_nodes; i++)
        to->unknowns[i] = from->unknowns[i] + room.load[i];
    Step step = {.unknowns = room.load, .stress = from->stress, .shear = to->shear,
                 .new_stress = to->stress, .new_shear = to->shear};
    advance(mesh, &room.tangents, &step);
    to->change = from->stress ? compare_stress(mesh, &body->law, &step) : 1.0;
    find_residual(mesh, to->stress, to->shear, to->imbalance);
    return FINE;
}
