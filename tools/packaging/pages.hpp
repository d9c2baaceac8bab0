#pragma once

#include <string>

namespace cartwright::packaging {

/// cartwright(1): every command with its options, asked from the program itself.
std::string program_page(const std::string& program);
/// cartwrightd(8): options asked from the program, the rig file from the README of firmware, running as a
/// service.
std::string daemon_page(const std::string& program, const std::string& readme);
/// cartwright-session(5): recordings, session.toml and import maps, from the README of host/session.
std::string session_page(const std::string& readme);
/// cartwright-model(5): the vocabulary, from its tables.
std::string model_page();
/// cartwright-registers(5): how to use it from the README of common/wire, the register map from its table.
std::string registers_page(const std::string& readme);

}  // namespace cartwright::packaging
