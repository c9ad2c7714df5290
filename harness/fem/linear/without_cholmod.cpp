// In place of cholmod_factor.cpp in a build without SuiteSparse.
#include "harness/base/errors.h"
#include "harness/fem/linear/factor.h"

namespace cutbench {

bool has_cholmod() { return false; }
std::string cholmod_version() { return "none"; }

template <int D>
std::unique_ptr<Factor<D>> make_cholmod_factor(FactorOrder /*order*/) {
  throw InputError("this build has no CHOLMOD");
}

template std::unique_ptr<Factor<1>> make_cholmod_factor(FactorOrder);
template std::unique_ptr<Factor<2>> make_cholmod_factor(FactorOrder);
template std::unique_ptr<Factor<3>> make_cholmod_factor(FactorOrder);

}  // namespace cutbench
