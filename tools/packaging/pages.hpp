#pragma once

#include <string>

namespace cartwright::packaging {

/// cartwright(1): every command with its options, asked from the program itself.
std::string program_page(const std::string& program);
/// cartwrightd(8): options asked from the program, the rig file and running as a service.
std::string daemon_page(const std::string& program);
/// cartwright-session(5): the recordings and session.toml.
std::string session_page();
/// cartwright-model(5): the vocabulary, from its tables.
std::string model_page();
/// cartwright-registers(5): the Modbus register map, from its table.
std::string registers_page();

}  // namespace cartwright::packaging
