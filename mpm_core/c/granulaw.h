/* Granulaw's contact laws for a particle code in any language: a law file is opened, the law of a pair of bodies
 * taken from it, and contacts are advanced step by step.
 *
 *     granulaw_law *law;
 *     granulaw_pair pair = {.a = "powder", .b = "wall"};
 *     granulaw_contact_law *contact;
 *     granulaw_why why;
 *     if (granulaw_open("powder.h5", &law, &why) || granulaw_contact(law, &pair, &contact, &why))
 *       fprintf(stderr, "%s\n", why.text);
 *
 * No state is global: threads may share laws that are open, and each advances contacts of its own. Nothing throws.
 * Structs that a later version extends keep their first members: fill them with zeros first.
 */
#ifndef GRANULAW_H
#define GRANULAW_H

#include <stddef.h>

#if defined(__GNUC__)
#define GRANULAW_API __attribute__((visibility("default")))
#else
#define GRANULAW_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct granulaw_law granulaw_law;                   /* a law file in memory */
typedef struct granulaw_contact_law granulaw_contact_law;   /* the law of one pair of bodies */

/* Return codes of the calls. */
enum {
  GRANULAW_OK = 0,
  GRANULAW_NO_FILE = 1,     /* the file cannot be read, or is no law file */
  GRANULAW_NO_LAW = 2,      /* the file has no law for this pair */
  GRANULAW_NO_NUMBER = 3,   /* a number is out of range, or none */
  GRANULAW_NO_POINTER = 4,  /* a pointer is null that must not be */
  GRANULAW_NO_MEMORY = 5
};

/* One sentence about what went wrong. */
typedef struct {
  char text[512];
} granulaw_why;

/* A pair of bodies. All zero but the names is a head-on contact of like sizes in SI. */
typedef struct {
  const char *a, *b;         /* materials of the file; b "wall": a rigid one */
  double radius_a, radius_b; /* chooses among laws by size; infinity: a deformable wall; both 0: like sizes */
  double length, mass;       /* SI values of the caller's units, m and kg; time is the second; 0: 1 */
  double stretch;            /* S: overlaps are S times the real ones, forces 1/S; 0: 1 */
  double friction;           /* coefficient; 0: no tangential force, and three values less */
  double shear_stiffness;    /* 8 G* of Mindlin's spring; 0: of the file's moduli, of body a alone at a rigid wall */
  double shear_damping;      /* of the spring, as part of critical */
  int yields_in_shear;       /* not 0: `tangential plastic` in place of Mindlin's spring, with any friction;
                                GRANULAW_NO_LAW where the file has no flow stress of the body that yields */
} granulaw_pair;

/* A contact's motion in a step, in the caller's units. */
typedef struct {
  double r_eff;       /* R* = R_i R_j/(R_i + R_j); at a wall the sphere's R */
  double m_eff;       /* m* = m_i m_j/(m_i + m_j); at a wall the sphere's m */
  double overlap;     /* R_i + R_j less the distance of the centres; 0 or less: the contact ends */
  double approach;    /* normal speed, positive: the surfaces come nearer */
  double dt;          /* s */
  double normal[3];   /* unit vector from j to i */
  double slide[3];    /* velocity of i's surface against j's at the contact, along it: a distance R_i - overlap/2
                         from i's centre; R_i - overlap at a rigid wall where the contact yields in shear */
  int asked_again;    /* not 0: nothing is kept and nothing booked */
  double turn[3];     /* rad/s, (omega_i - omega_j) x normal; of a contact that yields in shear */
} granulaw_motion;

/* Force on i; j gets the opposite. */
typedef struct {
  double normal;          /* along `normal`, 0 or more */
  double stiffness;       /* slope of the normal law on its branch */
  double contact_radius;  /* of the real, unstretched contact */
  double shear[3];
  double couple[3];       /* on i, beside the torque of `shear`; j gets the opposite */
} granulaw_answer;

/* Places of the ledger: energy that contacts took and do not give back. */
enum { GRANULAW_PLASTIC = 0, GRANULAW_WAVES = 1, GRANULAW_FRICTION = 2, GRANULAW_SHEAR = 3, GRANULAW_MECHANISMS = 4 };

/* Range of a law. */
typedef struct {
  double overlap;   /* over R*: beyond it the force goes on with its last stiffness */
  double onset;     /* over R*: of first yield; infinity: never */
  double slowest, fastest; /* approach speeds for which the law's velocity axis holds; 0 and infinity: all */
} granulaw_range;

/* Opens a law file of `mpm table`. */
GRANULAW_API int granulaw_open(const char *path, granulaw_law **law, granulaw_why *why);
/* Contact laws taken from it stay valid. Null: nothing happens. */
GRANULAW_API void granulaw_close(granulaw_law *law);

/* The law of a pair. */
GRANULAW_API int granulaw_contact(const granulaw_law *law, const granulaw_pair *pair, granulaw_contact_law **contact,
                                  granulaw_why *why);
GRANULAW_API void granulaw_close_contact(granulaw_contact_law *contact);

/* Doubles that a contact keeps from step to step: zero in one that begins. Of a null contact: 0. */
GRANULAW_API size_t granulaw_kept(const granulaw_contact_law *contact);
/* Not 0: the value at this place changes sign where i and j change places. Of a null contact: 0. */
GRANULAW_API int granulaw_turns(const granulaw_contact_law *contact, size_t place);

/* Range of the law for bodies of this R* and m*. Of a null contact: no numbers (NaN). */
GRANULAW_API granulaw_range granulaw_range_of(const granulaw_contact_law *contact, double r_eff, double m_eff);

/* Advances n contacts by a step. kept: granulaw_kept() doubles of each contact, one after the other. ledger:
 * GRANULAW_MECHANISMS numbers that are added to; null: nothing is booked. Stops at the first motion that has no number
 * where it needs one: that contact and those behind it are left as they were. */
GRANULAW_API int granulaw_advance(const granulaw_contact_law *contact, size_t n, const granulaw_motion *motion, double *kept,
                                  granulaw_answer *answer, double *ledger);

#ifdef __cplusplus
}
#endif

#endif
