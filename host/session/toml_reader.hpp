#pragma once

#include "common/config/toml_reader.hpp"
