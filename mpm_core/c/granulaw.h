/* Granulaw's contact laws for a particle code in any language: a law file is opened, the law of a pair of materials
 * taken from it, and contacts are advanced step by step.
 *
 *     granulaw_law *law;
 *     granulaw_pair pair;
 *     granulaw_contact_law *contact;
 *     granulaw_why why;
 *     granulaw_usual_pair(&pair, sizeof pair);
 *     pair.a = "powder", pair.b = "wall", pair.friction = 0.3;
 *     if (granulaw_open("powder.h5", &law, &why) || granulaw_contact(law, &pair, &contact, &why))
 *       fprintf(stderr, "%s\n", why.text);
 *
 * Threads may share laws that are open, and each advances contacts of its own. Nothing throws.
 *
 * Versions: set the member `size` of each struct to its sizeof. A program then runs with the library of any later
 * version 1, and with an older one as long as it leaves the members that this one lacks at 0. Else the call says so.
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

/* Version of this interface: that of the library's file name. */
#define GRANULAW_ABI 1
/* GRANULAW_ABI of the library that runs. */
GRANULAW_API unsigned granulaw_abi(void);
/* Granulaw's version, "0.1.0". */
GRANULAW_API const char *granulaw_version(void);

typedef struct granulaw_law granulaw_law;                   /* a law file in memory */
typedef struct granulaw_contact_law granulaw_contact_law;   /* the law of two materials, for bodies of any size */

/* Return codes of the calls. */
enum {
  GRANULAW_OK = 0,
  GRANULAW_NO_FILE = 1,     /* the file cannot be read, or is no law file */
  GRANULAW_NO_LAW = 2,      /* the file has no law for this pair */
  GRANULAW_NO_NUMBER = 3,   /* a number is out of range, or none */
  GRANULAW_NO_POINTER = 4,  /* a pointer is null that must not be */
  GRANULAW_NO_MEMORY = 5,
  GRANULAW_NO_SIZE = 6      /* `size` of a struct is not set, or a member is that this library does not know */
};

/* One sentence about what went wrong. */
typedef struct {
  char text[512];
} granulaw_why;

/* ---- a law file ---- */

/* Opens a law file of `mpm table`. */
GRANULAW_API int granulaw_open(const char *path, granulaw_law **law, granulaw_why *why);
/* The same of a file's bytes, for the other ranks of a parallel run; `name` is for sentences. */
GRANULAW_API int granulaw_open_image(const void *bytes, size_t count, const char *name, granulaw_law **law,
                                     granulaw_why *why);
/* Contact laws taken from it stay valid. Null: nothing happens. */
GRANULAW_API void granulaw_close(granulaw_law *law);

/* A material of the file, SI. */
typedef struct {
  size_t size;
  const char *name; /* valid until the file is closed */
  double density, youngs_modulus, poisson_ratio;
  double yield_stress; /* infinity: elastic */
} granulaw_material;

/* How many materials the file has, and one of them. */
GRANULAW_API size_t granulaw_materials(const granulaw_law *law);
GRANULAW_API int granulaw_material_of(const granulaw_law *law, size_t place, granulaw_material *material);
/* How many pairs of materials the file is for, and the names of one; b may be "wall". Valid until the file is closed. */
GRANULAW_API size_t granulaw_pairs(const granulaw_law *law);
GRANULAW_API int granulaw_pair_of(const granulaw_law *law, size_t place, const char **a, const char **b);

/* ---- the law of a pair ---- */

/* Two materials in contact, and how the caller computes. */
typedef struct {
  size_t size;
  const char *a, *b;          /* materials of the file; b "wall": a rigid one */
  double radius_a, radius_b;  /* of most bodies, b's infinity: a deformable wall; waves are those of this ratio. Both 0:
                                 of the ratio of each law of the file */
  double length, mass, time;  /* SI values of the caller's units, m, kg and s; 0: 1 */
  double stretch;             /* S: overlaps are S times the real ones, forces 1/S; 0: 1 */
  double friction;            /* coefficient; 0: no tangential force, and three values less */
  double shear_stiffness;     /* 8 G* of Mindlin's spring; 0: of the file's moduli, of a alone at a rigid wall */
  double shear_damping;       /* of the spring, as part of critical */
  double elastic_damping;     /* of a contact that never yielded, as part of critical */
  int yields_in_shear;        /* not 0: `tangential plastic` in place of Mindlin's spring, with any friction;
                                 GRANULAW_NO_LAW where the file has no flow stress of the body that yields */
  int no_waves;               /* not 0: waves take nothing (`waves off`) */
  double work_of_adhesion;    /* of the two surfaces, energy over area, not stretched; 0: they do not stick. Not with yields_in_shear.
                                 GRANULAW_NO_LAW where the radii are given and adhesion does not hold for them (`cohesion dent`) */
  double adhesion_range;      /* gap at which the attraction ends; 0: 0.4 nm */
} granulaw_pair;

/* A pair without names, as `pair_style gran model mpm tangential history` has it by default: SI units, no friction,
 * shear_damping 0.1, elastic_damping 0.001. size: sizeof(granulaw_pair). */
GRANULAW_API void granulaw_usual_pair(granulaw_pair *pair, size_t size);

/* The law of a pair. */
GRANULAW_API int granulaw_contact(const granulaw_law *law, const granulaw_pair *pair, granulaw_contact_law **contact,
                                  granulaw_why *why);
GRANULAW_API void granulaw_close_contact(granulaw_contact_law *contact);

/* Doubles that a contact keeps from step to step: all zero in one that begins. Of a null contact: 0. */
GRANULAW_API size_t granulaw_history(const granulaw_contact_law *contact);
/* Not 0: the value at this place changes sign where the two bodies change places. Of a null contact: 0. */
GRANULAW_API int granulaw_changes_sign(const granulaw_contact_law *contact, size_t place);
/* Not 0: the value follows from the others, and may be 0 after a restart or an exchange. Of a null contact: 0. */
GRANULAW_API int granulaw_is_derived(const granulaw_contact_law *contact, size_t place);

/* Range of a law, in the caller's units. */
typedef struct {
  size_t size;
  double overlap;          /* over R*: beyond it the force goes on with its last stiffness */
  double yield_overlap;    /* over R*: of first yield; infinity: never */
  double slowest, fastest; /* approach speeds for which the law's velocity axis holds; 0 and infinity: all */
  double reach;            /* gap over R*, up to which surfaces that stick may hold each other: for neighbour lists */
} granulaw_range;

/* Error of the law: 95 % of impacts lie within. Infinity: the file states none for such an impact. */
typedef struct {
  size_t size;
  double force;                /* of the largest force, relative */
  double restitution;          /* of e, absolute, */
  double relative_restitution; /* and this part of e beside it */
} granulaw_bound;

/* For bodies of these radii (of a and of b; at a wall radius_b is infinity), m* and, of the bound, this speed. */
GRANULAW_API int granulaw_range_of(const granulaw_contact_law *contact, double radius_a, double radius_b, double m_eff,
                                   granulaw_range *range);
GRANULAW_API int granulaw_bound_of(const granulaw_contact_law *contact, double radius_a, double radius_b, double m_eff,
                                   double speed, granulaw_bound *bound);

/* ---- a step ---- */

/* A contact's motion in a step, in the caller's units. Body a is of the pair's material a, b of b; of one material
 * either may be a, but it stays. */
typedef struct {
  size_t size;
  double radius_a, radius_b; /* of the bodies; radius_b infinity: a wall */
  double m_eff;       /* m* = m_a m_b/(m_a + m_b); at a wall the body's m */
  double overlap;     /* R_a + R_b less the distance of the centres; 0 or less: the contact ends, unless adhesion holds it */
  double approach;    /* normal speed, positive: the surfaces come nearer */
  double dt;          /* time step, > 0: not checked */
  double normal[3];   /* unit vector from b to a: its length is not checked */
  double slide[3];    /* velocity of a's surface against b's at the contact, along it: a distance R_a - overlap/2
                         from a's centre; R_a - overlap at a rigid wall where the contact yields in shear */
  double rolling[3];  /* rad over time, (omega_a - omega_b) x normal; of a contact that yields in shear */
  int asked_again;    /* not 0: nothing is kept and nothing booked */
} granulaw_motion;

/* Bits of granulaw_answer::beyond: what of a step the law does not hold for. */
enum {
  GRANULAW_BEYOND_OVERLAP = 1, /* deeper than the law's table: the force goes on with its last stiffness */
  GRANULAW_BEYOND_FAST = 2,    /* it began faster than the velocity axis goes: the fastest impact stands in */
  GRANULAW_BEYOND_SLOW = 4,    /* it began slower than a rate axis begins: the slowest impact stands in */
  GRANULAW_BEYOND_SIZE = 8     /* the bodies' sizes are none that the file has a law for */
};

/* Force on a; b gets the opposite. */
typedef struct {
  size_t size;
  double normal;    /* along `normal`, 0 or more; where surfaces stick of any sign */
  double shear[3];
  double couple[3]; /* on a, beside the torque of `shear`; b gets the opposite */
  unsigned beyond;  /* OVERLAP in each step, the others in a contact's first */
} granulaw_answer;

/* Places of the ledger: energy that contacts took and do not give back. A contact that two ranks compute is booked
 * by both. */
enum { GRANULAW_PLASTIC = 0, GRANULAW_WAVES = 1, GRANULAW_FRICTION = 2, GRANULAW_SHEAR = 3, GRANULAW_ADHESION = 4, GRANULAW_MECHANISMS = 5 };

/* Advances n contacts by a step: forces. history: granulaw_history() doubles of each contact, one after the other.
 * ledger: GRANULAW_MECHANISMS numbers that are added to; null: nothing is booked. done: how many contacts were
 * advanced; may be null. Stops at the first motion that has no number where it needs one: that contact and those behind
 * it are left as they were. All motions, and all answers, have one size: that of the first. */
GRANULAW_API int granulaw_advance(const granulaw_contact_law *contact, size_t n, const granulaw_motion *motion,
                                  double *history, granulaw_answer *answer, double *ledger, size_t *done);

/* Where a contact is on its law. */
enum { GRANULAW_APART = 0, GRANULAW_LOADING = 1, GRANULAW_UNLOADING = 2 };

/* What a contact is beside its force, after granulaw_advance() with the same motion. */
typedef struct {
  size_t size;
  double stiffness;       /* slope of the normal law on its branch */
  double contact_radius;  /* of the real, unstretched contact */
  double stored_energy;   /* that the contact gives back when the bodies part; where surfaces stick it may be negative */
  double largest_overlap; /* since first touch */
  int branch;
} granulaw_state;

/* For output: nothing is kept. */
GRANULAW_API int granulaw_state_of(const granulaw_contact_law *contact, size_t n, const granulaw_motion *motion,
                                   const double *history, granulaw_state *state);

#ifdef __cplusplus
}
#endif

#endif
