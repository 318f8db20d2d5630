#pragma once

#include <string>

class QPDF;

namespace telestrain {

// One signature's update: whose it is and the number of the object that holds it.
struct SignedUpdate {
  std::string role;
  int object = 0;
};

// Compares every object of a revision with the next one, which a signature added. Only these may
// differ: the value of the role's field and its picture, which fills the field's box; the form's
// flags; one invisible field appended to the form and to a page's annotations; the catalog's /Perms
// by the instrument's seal. Returns what else was changed, as "page 3's content (object 12) was
// changed", or nothing.
std::string ForbiddenChange(QPDF& before, QPDF& after, const SignedUpdate& update);

}  // namespace telestrain
