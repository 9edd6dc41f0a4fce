#pragma once

#include <string>

#include <gtest/gtest.h>

#include "base/error.h"

namespace foveray::fakes {

/// `action` throws a Fault with that code whose one line contains `part`.
template <typename Action>
void expect_fault(Action action, ExitCode code, const std::string& part) {
    try {
        action();
        ADD_FAILURE() << "no Fault; expected one about '" << part << "'";
    } catch (const Fault& fault) {
        EXPECT_EQ(fault.code(), code) << fault.what();
        EXPECT_NE(std::string(fault.what()).find(part), std::string::npos) << fault.what();
        EXPECT_EQ(std::string(fault.what()).find('\n'), std::string::npos) << fault.what();
    }
}

}  // namespace foveray::fakes
