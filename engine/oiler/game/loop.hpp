// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// What a game asks of the loop that runs it: `void update(const Input& input, Loop& loop)`.
class Loop {
public:
    /// Makes the game anew after this update, with the settings of its world. The picture jumps.
    void restart() { restarts_ = true; }
    /// Takes no step of the world after this update, as in a menu: its tick and hash stay.
    void hold() { holds_ = true; }
    /// Lets keys enter text, see Input::text, until it is switched off. Meanwhile only Enter,
    /// Escape, Backspace, Tab and the arrows act as keys.
    void text_input(bool on) { takes_text_ = on; }
    /// Ends the program after this update.
    void quit() { quits_ = true; }

    [[nodiscard]] bool restarts() const { return restarts_; }
    [[nodiscard]] bool holds() const { return holds_; }
    [[nodiscard]] bool takes_text() const { return takes_text_; }
    [[nodiscard]] bool quits() const { return quits_; }
    /// Forgets what was asked for the last step only.
    void begin_step() { restarts_ = holds_ = false; }

private:
    bool restarts_ = false;
    bool holds_ = false;
    bool takes_text_ = false;
    bool quits_ = false;
};

}  // namespace oiler
