#include "host/reproduce/relay_examples.hpp"
#include "host/reproduce/sinefit_examples.hpp"

namespace cartwright::reproduce {

Result<PaperTable> relay_paper(const ReproduceOptions& options) {
  PaperTable table{
      "relay", "Sine fitting and dual-relay friction identification (Dou, Chen; Tan, Lee and others)", {}};
  auto record = relay_record_example();
  if (!record) return tl::unexpected(record.error());
  table.sections.push_back(*std::move(record));
  table.sections.push_back(noise_examples(options));
  auto identification = relay_identification();
  if (!identification) return tl::unexpected(identification.error());
  table.sections.push_back(*std::move(identification));
  return table;
}

}  // namespace cartwright::reproduce
