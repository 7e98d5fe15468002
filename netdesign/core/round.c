/* A round of flow and net: the mesh along a curve, the flow on it, the net under it.
 *
 * One call for what coupling/steady/round.py does step by step: snow/mesh.py
 * (place_nodes), snow/placed_mesh.py, snow/flow.py, coupling/interface.py
 * (share_net_forces) and coupling/steady/net.py. */
#include "round.h"

#include <math.h>
#include <string.h>

enum { CORNER_SHARE = 4 };

/* A scene on one mesh; what changes from round to round stands in the results. */
typedef struct {
    Placement place;
    Mesh mesh;
    Law law, first; /* first: of one step before the others, where nothing is known */
    Rules rules;
    const int32_t *plan;
    Effort effort;
    /* the mesh along a curve */
    int32_t n_vertices;      /* midpoints of edges come after them */
    const double *reference; /* (2, n_nodes): the template's nodes */
    const double *follow;    /* (n_nodes,): share of the net's way that a node takes */
    const int32_t *below;    /* (n_nodes,): node of the net at or below its height */
    const double *rise;      /* (n_nodes,): its height above that */
    const double *heights;   /* (n_net,): of the net's nodes */
    const int32_t *ends;     /* (2, n_nodes - n_vertices): of each edge */
    /* load */
    double gravity[2];
    int32_t is_uniform;
    const double *density;   /* (n_triangles, 3), or one number */
    const double *end_share; /* (n_nodes,): of a load on the upslope end, along X */
    const double *edge_weights; /* (4,): of the quadrature on an edge */
    /* net */
    int32_t n_elements, n_parts;
    const double *shares;    /* (n_elements,): of an element in its part */
    const int64_t *part, *firsts;
    const double *rises, *head;
    double end_load, length, stiffness, tolerance;
} Scene;

/* A net under forces, as ``NetEquilibrium`` has it. */
typedef struct {
    double *forces, *lengths, *parts, *curve, *pull, *tension, *ends;
} Hung;

/* Results of a round, one after the other in one array. */
typedef struct {
    double *nodes, *weights, *gradients, *unit_load, *normal, *axes, *edge_weights, *load;
    State state;
    Hung net;     /* under the reactions of the flow */
    Hung settled; /* under the forces of its stresses alone */
    double *residual, *on_ground, *ground_normal; /* of these: (2 n_nodes,), (2,) ... */
    double *unbalanced; /* ... (2 n_edges,), (1,): not asked for below 0 */
    double *way;        /* (1,): largest one of the net's nodes, along an axis */
} Found;

static double *take(double **next, size_t count) {
    double *first = *next;
    *next += count;
    return first;
}

static Hung take_net(double **next, const Scene *scene) {
    size_t n = (size_t)scene->n_elements;
    Hung net;
    net.forces = take(next, 2 * (2 * n + 1));
    net.lengths = take(next, n);
    net.parts = take(next, (size_t)scene->n_parts);
    net.curve = take(next, 2 * (2 * n + 1));
    net.pull = take(next, 2);
    net.tension = take(next, 2 * n);
    net.ends = take(next, 4);
    return net;
}

/* Places of the results, and how many numbers they take in all;
 * coupling/steady/compiled.py has the same list. */
static size_t lay_out(const Scene *scene, double *results, int32_t slides, Found *to) {
    size_t nodes = (size_t)scene->mesh.n_nodes, net = (size_t)scene->mesh.n_net;
    size_t points = (size_t)POINTS * (size_t)scene->mesh.n_triangles;
    size_t edges = (size_t)scene->mesh.n_edges;
    double *next = results;
    to->nodes = take(&next, 2 * nodes);
    to->weights = take(&next, points);
    to->gradients = take(&next, 2 * TRIANGLE * points);
    to->unit_load = take(&next, nodes);
    to->normal = take(&next, 2 * net);
    to->axes = take(&next, 2 * nodes);
    to->edge_weights = take(&next, EDGE_POINTS * edges);
    to->load = take(&next, 2 * nodes);
    to->state.numbers = take(&next, 4 * nodes + PLANE * points);
    if (slides) take(&next, EDGE_POINTS * edges);
    to->state.slides = slides;
    to->state.contact.sign = (int64_t *)take(&next, net - 1);
    to->net = take_net(&next, scene);
    to->settled = take_net(&next, scene);
    to->residual = take(&next, 2 * nodes);
    to->on_ground = take(&next, 2);
    to->ground_normal = take(&next, 2 * edges);
    to->unbalanced = take(&next, 1);
    to->way = take(&next, 1);
    to->state.contact.is_pressed = (uint8_t *)next;
    to->state.contact.is_open = to->state.contact.is_pressed + net - 1;
    to->state.contact.is_lifted = to->state.contact.is_open + net - 1;
    return (size_t)(next - results) + (2 * (net - 1) + 2 * edges) / sizeof *results + 1;
}

/* Nodes between the net's curve (2, n_net) and snow that does not follow it. */
static void place_nodes(const Scene *scene, const double *curve, double *nodes) {
    int32_t count = scene->mesh.n_nodes, n_net = scene->mesh.n_net;
    for (int axis = 0; axis < 2; axis++) {
        double *at = nodes + (size_t)axis * (size_t)count;
        const double *net = curve + axis * n_net;
        for (int32_t i = 0; i < scene->n_vertices; i++) {
            int32_t j = scene->below[i];
            double to = net[j], height = scene->reference[count + i];
            if (scene->rise[i] != 0.0)
                to += (net[j + 1] - net[j]) / (scene->heights[j + 1] - scene->heights[j])
                      * scene->rise[i];
            at[i] = axis ? height + scene->follow[i] * (to - height)
                         : scene->follow[i] * to - scene->reference[i];
        }
        int32_t n_edges = count - scene->n_vertices;
        for (int32_t i = 0; i < n_edges; i++)
            at[scene->n_vertices + i] =
                (at[scene->ends[i]] + at[scene->ends[n_edges + i]]) / 2.0;
        for (int32_t i = 0; i < n_net; i++) at[scene->mesh.net[i]] = net[i];
    }
}

static int is_valid(const Mesh *mesh) {
    for (int32_t i = 0; i < POINTS * mesh->n_triangles; i++)
        if (!(mesh->weights[i] > 0.0 && isfinite(mesh->weights[i]))) return 0;
    return 1;
}

/* Weight of the snow and load on its end, in node axes. */
static void fill_load(const Scene *scene, const Found *found) {
    const Mesh *mesh = &scene->mesh;
    double *load = found->load, mass = 0.0;
    memset(load, 0, 2 * (size_t)mesh->n_nodes * sizeof *load);
    for (int32_t i = 0; !scene->is_uniform && i < POINTS * mesh->n_triangles; i++) {
        mass = found->weights[i] * scene->density[i];
        for (int k = 0; k < TRIANGLE; k++) /* for now masses, each in the second place */
            load[2 * scene->mesh.triangles[TRIANGLE * (i / POINTS) + k] + 1] +=
                mass * scene->place.shape[TRIANGLE * (i % POINTS) + k];
    }
    for (int32_t i = 0; i < mesh->n_nodes; i++) {
        double c = found->axes[i], s = found->axes[mesh->n_nodes + i];
        mass = scene->is_uniform ? found->unit_load[i] * scene->density[0]
                                 : load[2 * i + 1];
        double x = mass * scene->gravity[0], y = mass * scene->gravity[1];
        double end = scene->end_load * scene->end_share[i];
        load[2 * i] = c * x + s * y + c * end;
        load[2 * i + 1] = -s * x + c * y - s * end;
    }
}

/* Lets scene and mesh have the arrays of the results. */
static void point(Scene *scene, const Found *found) {
    Placement *to = &scene->place;
    Mesh *mesh = &scene->mesh;
    to->nodes = found->nodes;
    mesh->gradients = to->gradients = found->gradients;
    mesh->weights = to->weights = found->weights;
    mesh->axes = to->axes = found->axes;
    mesh->edge_weights = found->edge_weights;
    mesh->load = found->load;
    to->load = found->unit_load;
    to->normal = found->normal;
}

/* The mesh along a curve; gives whether no triangle of it is turned over. */
static int place(Scene *scene, const double *curve, const Found *found) {
    const Mesh *mesh = &scene->mesh;
    point(scene, found);
    place_nodes(scene, curve, found->nodes);
    place_mesh(&scene->place);
    for (int32_t e = 0; e < mesh->n_edges; e++) {
        double start = found->nodes[mesh->ground[2 * e]];
        double half = fabs(found->nodes[mesh->ground[2 * e + 2]] - start) / 2.0;
        for (int q = 0; q < EDGE_POINTS; q++)
            found->edge_weights[EDGE_POINTS * e + q] = half * scene->edge_weights[q];
    }
    fill_load(scene, found);
    return is_valid(mesh);
}

/* Everything held, without stress or velocity. */
static void rest(const Mesh *mesh, const State *state) {
    size_t net = (size_t)mesh->n_net - 1, edges = (size_t)mesh->n_edges;
    size_t count = 4 * (size_t)mesh->n_nodes + (size_t)(PLANE * POINTS * mesh->n_triangles);
    if (state->slides) count += EDGE_POINTS * edges;
    memset(state->numbers, 0, count * sizeof *state->numbers);
    memset(state->contact.sign, 0, net * sizeof *state->contact.sign);
    memset(state->contact.is_pressed, 1, net);
    memset(state->contact.is_open, 0, net + 2 * edges); /* lifted ones come next */
}

/* Forces of the snow on the net of these reactions, the foot's corner shared; 0 on a
 * free end. */
static void share_forces(const Scene *scene, const double *reaction, double *forces) {
    const Mesh *mesh = &scene->mesh;
    double *x = forces, *y = x + 2 * scene->n_elements + 1;
    for (int32_t i = 0; i < 2 * scene->n_elements + 1; i++) {
        x[i] = y[i] = 0.0;
        if (i >= mesh->n_net) continue;
        int32_t node = mesh->net[i];
        double c = mesh->axes[node], s = mesh->axes[mesh->n_nodes + node];
        x[i] = -(c * reaction[2 * node] - s * reaction[2 * node + 1]);
        y[i] = -(s * reaction[2 * node] + c * reaction[2 * node + 1]);
    }
    if (scene->rules.holds_along) x[0] = x[1] / CORNER_SHARE;
    y[0] = y[1] / CORNER_SHARE;
}

static void fill_lengths(const Scene *scene, const Hung *net) {
    for (int32_t e = 0; e < scene->n_elements; e++)
        net->lengths[e] = scene->shares[e] * net->parts[scene->part[e]];
}

static int part(const Scene *scene, const Hung *net, double *pull) {
    int fault = part_cable(scene->n_elements, scene->n_parts, net->forces, scene->shares,
                           scene->firsts, scene->rises, scene->head[0], scene->length,
                           scene->stiffness, pull, net->parts);
    return fault == OPEN ? UNPARTED : fault;
}

static int stretch(const Scene *scene, const Hung *net, double *pull) {
    return hang_cable(scene->n_elements, net->forces, net->lengths, scene->stiffness,
                      scene->head, scene->tolerance, pull, net->curve, net->tension,
                      net->ends);
}

/* The net under its forces. */
static int hang(const Scene *scene, const Hung *net) {
    fill_lengths(scene, net);
    if (scene->n_parts > 1) {
        double pull[2] = {net->pull[0], net->pull[1]};
        int fault = part(scene, net, pull);
        if (fault == UNPARTED) { /* once more from the pull of the lengths as they were */
            pull[0] = net->pull[0];
            pull[1] = net->pull[1];
            fault = stretch(scene, net, pull);
            if (!fault) fault = part(scene, net, pull);
        }
        if (fault) return fault;
        fill_lengths(scene, net);
    }
    return stretch(scene, net, net->pull);
}

/* Largest distance along an axis of the net and the curve that it was given; no number
 * where one of them is none. */
static double find_way(const Scene *scene, const double *curve, const Hung *net) {
    double way = 0.0;
    for (int axis = 0; axis < 2; axis++) {
        const double *now = net->curve + axis * (2 * scene->n_elements + 1);
        for (int32_t i = 0; i < scene->mesh.n_net; i++) {
            double away = fabs(now[i] - curve[axis * scene->mesh.n_net + i]);
            if (isnan(away)) return away;
            way = fmax(way, away);
        }
    }
    return way;
}

/* Forces on the ground, and the norm of those that nothing takes; the residual forces
 * of what holds the snow are 0 then. */
static void find_ground_forces(const Scene *scene, const Found *found) {
    const Mesh *mesh = &scene->mesh;
    const Contact *contact = &found->state.contact;
    double *left = found->residual, sum[2] = {0.0, 0.0}, square = 0.0;
    const double *shear = found->state.numbers + 4 * mesh->n_nodes
                          + PLANE * POINTS * mesh->n_triangles;
    int32_t foot = mesh->ground[0], last = 2 * scene->n_elements + 1;
    for (int32_t i = 0; i < 2 * mesh->n_edges; i++) {
        int32_t at = 2 * mesh->ground[i + 1];
        sum[0] -= left[at];
        sum[1] -= left[at + 1];
        found->ground_normal[i] = left[at + 1];
        if (contact->is_lifted[i]) continue;
        left[at + 1] = 0.0;
        if (scene->rules.holds_along) left[at] = 0.0;
    }
    found->on_ground[1] = sum[1] - left[2 * foot + 1] - found->settled.forces[last];
    found->on_ground[0] = 0.0;
    if (scene->rules.holds_along)
        found->on_ground[0] = sum[0] - left[2 * foot] - found->settled.forces[0];
    for (int32_t i = 0; found->state.slides && i < EDGE_POINTS * mesh->n_edges; i++)
        found->on_ground[0] += found->edge_weights[i] * shear[i];
    left[2 * foot] = left[2 * foot + 1] = 0.0;
    for (int32_t i = 0; i < mesh->n_net - 1; i++) {
        int32_t at = 2 * mesh->net[i + 1];
        if (!contact->is_open[i]) left[at] = 0.0;
        left[at + 1] = 0.0; /* friction, tested on its own */
    }
    for (int32_t i = 0; i < 2 * mesh->n_nodes; i++) square += left[i] * left[i];
    found->unbalanced[0] = sqrt(square);
}

/* Forces from the stresses of the snow alone, and the net under them. */
static int settle(const Scene *scene, const Found *found) {
    const Mesh *mesh = &scene->mesh;
    const double *stress = found->state.numbers + 4 * mesh->n_nodes;
    const double *shear = stress + PLANE * POINTS * mesh->n_triangles;
    const Hung *from = &found->net, *to = &found->settled;
    find_residual(mesh, stress, found->state.slides ? shear : NULL, found->residual);
    share_forces(scene, found->residual, to->forces);
    find_ground_forces(scene, found);
    memcpy(to->parts, from->parts, (size_t)scene->n_parts * sizeof *to->parts);
    memcpy(to->pull, from->pull, 2 * sizeof *to->pull);
    return hang(scene, to);
}

/* A round along a curve (2, n_net) above the ground. Its results are laid out in
 * ``results`` (size,), in which the state of the flow, the parts' lengths and the pull stand as
 * it starts; ``is_known`` tells whether the state does. A net that moves less than
 * ``still`` is settled, if it can be. OFF_MESH and so on where a step of the round
 * fails. */
EXPORT int32_t nd_round(Scene *scene, const double *curve, double still, int32_t is_known,
                        int32_t slides, int64_t size, double *results) {
    Found found;
    if (lay_out(scene, results, slides, &found) != (size_t)size) return BAD_INPUT;
    found.unbalanced[0] = -1.0;
    for (int32_t i = 1; i < scene->mesh.n_net; i++)
        if (!(curve[scene->mesh.n_net + i] > 0.0)) return OFF_MESH;
    if (!place(scene, curve, &found)) return OFF_MESH;
    if (!is_known) rest(&scene->mesh, &found.state);
    int fault = solve_flow(&scene->mesh, &scene->law, is_known ? NULL : &scene->first,
                           &scene->rules, scene->plan, &found.state, &scene->effort);
    if (!fault) {
        share_forces(scene, found.state.numbers + 2 * scene->mesh.n_nodes,
                     found.net.forces);
        fault = hang(scene, &found.net);
    }
    if (!fault) found.way[0] = find_way(scene, curve, &found.net);
    if (fault || !(found.way[0] < still)) return fault;
    fault = settle(scene, &found);
    if (fault > 0) found.unbalanced[0] = -1.0;
    return fault < 0 ? fault : FINE;
}

/* The net under forces on its nodes in the snow, ``at_net`` (2, n_net), by the parts'
 * lengths and the pull in ``results``. */
EXPORT int32_t nd_hang(const Scene *scene, const double *at_net, int32_t slides,
                       int64_t size, double *results) {
    Found found;
    if (lay_out(scene, results, slides, &found) != (size_t)size) return BAD_INPUT;
    int32_t count = 2 * scene->n_elements + 1, n_net = scene->mesh.n_net;
    for (int axis = 0; axis < 2; axis++)
        for (int32_t i = 0; i < count; i++)
            found.net.forces[axis * count + i] = i < n_net ? at_net[axis * n_net + i] : 0.0;
    return hang(scene, &found.net);
}

/* Forces at the net's nodes that their unit velocities give, root (2 n_net, 2 n_net),
 * about the state of a round. */
EXPORT int32_t nd_root(Scene *scene, int32_t slides, int64_t size, double *results,
                       double *root) {
    Found found;
    if (lay_out(scene, results, slides, &found) != (size_t)size) return BAD_INPUT;
    point(scene, &found);
    const double *stress = found.state.numbers + 4 * scene->mesh.n_nodes;
    const double *shear = stress + PLANE * POINTS * scene->mesh.n_triangles;
    Step step = {.stress = stress, .shear = slides ? shear : NULL,
                 .contact = found.state.contact, .root = root};
    Room room;
    int fault = open_room(&scene->mesh, scene->plan, &room);
    if (fault) return fault;
    fault = take_step(&scene->mesh, &scene->law, &scene->rules, &step, scene->plan, &room);
    free(room.memory);
    return fault;
}
