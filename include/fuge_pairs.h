/* fuge - contact between two surfaces of finite elements.  SPDX-License-Identifier: BSD-3-Clause
 *
 * Included by fuge.h, whose conventions hold here too. */
#ifndef FUGE_PAIRS_H
#define FUGE_PAIRS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- pairs of surfaces --------------------------------------------------
 *
 * From two surfaces whose nodes do not face each other to contact points: their gaps, and
 * the combinations of degrees of freedom of both bodies that fuge_body_set_contact takes.
 * Both bodies are in one stiffness matrix.  Sliding is small: the pairs are those of the
 * positions given.
 *
 *     fuge_pairs_create -> fuge_pairs_set_contact, fuge_pairs_set_opposite -> fuge_pairs_find
 *     (again for each further pair of surfaces) -> fuge_pairs_get_...
 *     -> fuge_body_set_contact(dof, normal), .., fuge_pairs_free
 *
 * Pressure = force/area. */

typedef struct fuge_pairs fuge_pairs;

/* Method: weighted gaps of the dual mortar method; or each node against the face across
 * from it, which fails the patch test: on meshes that do not match it does not reproduce a
 * uniform pressure. */
enum { FUGE_MORTAR = 0, FUGE_NODE_TO_FACE = 1 };

/* Normals: averaged at the nodes of the contact surface; those of the opposite faces;
 * given at the nodes of the contact surface. */
enum { FUGE_NORMALS_AVERAGED = 0, FUGE_NORMALS_OPPOSITE = 1, FUGE_NORMALS_GIVEN = 2 };

/* An empty set of pairs.  *pairs is set on success only.  FUGE_ERR_MEMORY. */
int fuge_pairs_create(fuge_pairs **pairs, char *message, size_t len);

/* Free and set *pairs to NULL; NULL and *pairs == NULL are fine. */
void fuge_pairs_free(fuge_pairs **pairs);

/* The surface whose nodes become contact points (with linear faces the coarser one, whose
 * pressures are smooth; with quadratic faces the finer one) and the opposite one, for the next
 * fuge_pairs_find; both are copied.
 *   dimensions  2 or 3
 *   node        positions, dimensions x nodes
 *   face        numbers of the nodes of each face, most x faces, from 0; unused places, at
 *               the end, are -1.  Faces have 2 or 3 nodes in the plane, 3, 4, 6 or 8 in
 *               space: corners first, then the nodes in the middle of the sides, that
 *               between corners 0 and 1, between 1 and 2, and so on.  In the plane the body
 *               lies to the left of the way from corner 0 to corner 1; in space the corners
 *               run counter-clockwise if seen from outside.
 *   dof         degrees of freedom of the nodes, dimensions x nodes, from 0; -1: does not
 *               move.  NULL: the surface is rigid.
 * Two surfaces that both look into their bodies face each other too: positions alone do not
 * tell.  fuge_bodies knows the bodies, and refuses them.
 * FUGE_ERR_SIZE, FUGE_ERR_MEMORY; the contents are checked by fuge_pairs_find. */
int fuge_pairs_set_contact(fuge_pairs *pairs, int dimensions, int nodes, const double *node, int most, int faces,
                           const int *face, const int *dof);
int fuge_pairs_set_opposite(fuge_pairs *pairs, int dimensions, int nodes, const double *node, int most, int faces,
                            const int *face, const int *dof);

/* How surfaces are understood from the next fuge_pairs_find on.
 *   crease      angle between the normals of neighbouring faces, in degrees from 0 to 90,
 *               beyond which a smooth body has an edge there, 25 at first: more than 360 over
 *               the number of elements round a full circle, less than the angle of any chamfer
 *   revolution  1: surfaces in the plane are those of bodies of revolution with the radius
 *               along x, areas are those of rings, and forces those of whole rings; 0, as at
 *               first
 * Both are checked by fuge_pairs_find. */
int fuge_pairs_set_geometry(fuge_pairs *pairs, double crease, int revolution);

/* Find the contact points of both surfaces and add them to those found before.
 *   normal  for FUGE_NORMALS_GIVEN: outwards from the contact surface at its nodes,
 *           dimensions x nodes, of any length; else NULL
 *   reach   how far apart, or one inside the other, opposite points may be, length; not
 *           above 0: as far as the surfaces extend
 *   play    between the lower and the upper stop, length: 0 for points that stay in contact
 *           but slide, INFINITY for one-sided contact
 *   tied    1: glue the surfaces where they are, along each axis; else 0
 *   smooth  1, as a rule: normals, gaps and areas of the smooth bodies that the meshes stand
 *           for, exact on circles, spheres and cylinders; faces that meet at more than 25
 *           degrees (or what fuge_pairs_set_geometry has set) keep their edge, flat faces stay
 *           flat.  0: those of the faces as they are, whose chords on a round body are wrong
 *           by L^2/(8 R)
 * FUGE_WARN_PAIRS: a node is a contact point of two pairs; where it moves alike in both, it is
 * listed once, with the area of both.  Errors, nothing is added: FUGE_ERR_SIZE,
 * FUGE_ERR_ELEMENT, FUGE_ERR_NOT_FINITE, FUGE_ERR_OVERFLOW, FUGE_ERR_DOF, FUGE_ERR_GAP,
 * FUGE_ERR_OPTION, FUGE_ERR_CALL_ORDER, FUGE_ERR_MEMORY; FUGE_ERR_MESH for a face that is
 * folded over, has no area or looks the wrong way, for a given normal that does, and for
 * surfaces that do not face each other. */
int fuge_pairs_find(fuge_pairs *pairs, int method, int normals, const double *normal, double reach, double play,
                    int tied, int smooth);

/* Contact points n, degrees of freedom of each (`width`), and nodes without an opposite.
 * Each pointer here and below may be NULL. */
int fuge_pairs_get_sizes(const fuge_pairs *pairs, int *n, int *width, int *unpaired);

/* What fuge_body_set_contact takes: both width x n, dof -1 where unused. */
int fuge_pairs_get_contact(const fuge_pairs *pairs, int *dof, double *normal);

/* Initial gaps, plays (both for fuge_set_gap) and areas, in the plane
 * lengths, n each. */
int fuge_pairs_get_gaps(const fuge_pairs *pairs, double *gap, double *gap_upper, double *area);

/* Where the contact points are: the pair and the node of its contact surface, the opposite
 * face (with FUGE_MORTAR that with the largest share), n each; the place in it,
 * (dimensions - 1) x n, and the direction of the gap, dimensions x n: the
 * force on the opposite body is force*direction, where direction is a unit vector, but between
 * smooth bodies the mean of those of the places that belong to the point.  Pairs, nodes and
 * faces count from 0. */
int fuge_pairs_get_points(const fuge_pairs *pairs, int *pair, int *node, int *face, double *place,
                          double *direction);

/* Pair and node of the nodes that have no opposite, and so are no contact points. */
int fuge_pairs_get_unpaired(const fuge_pairs *pairs, int *pair, int *node);

/* Message of the last call on pairs that set or found, or of the last error; as
 * fuge_body_message. */
int fuge_pairs_message(const fuge_pairs *pairs, char *message, size_t len);

#ifdef __cplusplus
}
#endif

#endif
