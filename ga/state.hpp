#pragma once

#include "ga/errors.hpp"

#include <nlohmann/json_fwd.hpp>

#include <memory>

namespace ga {

/// The state of an operator, whatever its type, as checkpoints and copies of a run handle it.
class AnyState {
  public:
    virtual ~AnyState() = default;
    virtual std::unique_ptr<AnyState> clone() const = 0; ///< a copy
    virtual void write(nlohmann::json& j) const = 0;     ///< as a checkpoint holds it
    virtual const nlohmann::json* stored() const {
        return nullptr;
    } ///< where it was read and not yet understood
};

/// A state of type S, which to_json and from_json write and read without loss.
template <class S>
class StateOf : public AnyState {
  public:
    S value{}; ///< the state

    std::unique_ptr<AnyState> clone() const override { return std::make_unique<StateOf>(*this); }
    void write(nlohmann::json& j) const override { to_json(j, value); }
};

/// A state that is copied with what holds it.
class HeldState {
  public:
    HeldState() = default;
    /// Takes a state.
    explicit HeldState(std::unique_ptr<AnyState> state) : state_(std::move(state)) {}
    /// A copy of its own.
    HeldState(const HeldState& other) : state_(other.state_ ? other.state_->clone() : nullptr) {}
    HeldState(HeldState&&) = default; ///< takes the other's
    /// A copy of its own.
    HeldState& operator=(HeldState other) {
        state_ = std::move(other.state_);
        return *this;
    }
    const AnyState& operator*() const { return *state_; } ///< the state

    /// The state as an S: new where there was none, understood where it was read from a checkpoint. Throws
    /// UsageError where what was read is no S.
    template <class S>
    S& as() {
        if (auto* own = dynamic_cast<StateOf<S>*>(state_.get()))
            return own->value;
        auto made = std::make_unique<StateOf<S>>();
        if (state_ && state_->stored())
            try {
                from_json(*state_->stored(), made->value);
            } catch (const std::exception&) { // the reader's words help nobody
                expect_fit(false);
            }
        S& value = made->value;
        state_ = std::move(made);
        return value;
    }

  private:
    std::unique_ptr<AnyState> state_;
};

} // namespace ga
