#include "host/reproduce/relay_examples.hpp"
#include "host/reproduce/sinefit_examples.hpp"

namespace cartwright::reproduce {

Paper relay_paper() {
  return {"relay",
          "Sine fitting and dual-relay friction identification (Dou, Chen; Tan, Lee and others)",
          {{"record", "memo 3.1: sine fit to a relay record", relay_record_example},
           {"noise", "memo 3.3: sine fit in noise, side lobes", noise_examples},
           {"relay", "memo 3.2 and paper Section 4: friction from relay tests", relay_identification}}};
}

}  // namespace cartwright::reproduce
