/* models.h: the models, each defined in its own file; brdf.c puts them into one table. */
#ifndef GLINT_BRDF_MODELS_H
#define GLINT_BRDF_MODELS_H

#include "brdf/brdf.h"

extern const brdf_model brdf_lambert;
extern const brdf_model brdf_ward;
extern const brdf_model brdf_ward_duer;
extern const brdf_model brdf_ward_gmd;
extern const brdf_model brdf_ashikhmin_shirley;
extern const brdf_model brdf_ashikhmin_premoze;
extern const brdf_model brdf_phong;
extern const brdf_model brdf_cook_torrance;
extern const brdf_model brdf_ggx;
extern const brdf_model brdf_oren_nayar;
extern const brdf_model brdf_minnaert;
extern const brdf_model brdf_lommel_seeliger;
extern const brdf_model brdf_hapke;
extern const brdf_model brdf_abg;
extern const brdf_model brdf_binomial;
extern const brdf_model brdf_five_parameter;
extern const brdf_model brdf_table;
extern const brdf_model brdf_mirror;

#endif
