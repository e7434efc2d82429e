;;; core-test.el --- The server through Eglot, by what a user calls  -*- lexical-binding: t -*-

;; usage: SDLC=… emacs --batch -l FILE/sdlc-mode.el -l core-test.el, in an empty folder
;; A line for each check, and a count.

;;; Code:
(require 'cl-lib)
(require 'eglot)
(require 'flymake)
(require 'imenu)
(require 'sdlc-mode)
(require 'xref)

(defconst core-camera "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n")
(defconst core-ball "sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }\n")
(defconst core-patience 20 "Seconds.")
(defvar core-passed 0)
(defvar core-failed 0)

(setq eglot-sync-connect core-patience
      eglot-confirm-server-initiated-edits nil
      make-backup-files nil
      create-lockfiles nil
      sdlc-program (getenv "SDLC"))

(defun core-until (what condition)
  "Wait until CONDITION holds; signal WHAT if it never does."
  (let ((end (+ (float-time) core-patience)) result)
    (while (not (setq result (funcall condition)))
      (when (> (float-time) end) (error "Never happened: %s" what))
      (accept-process-output nil 0.02))
    result))

(defun core-open (name &rest lines)
  "Open the file NAME with LINES; Eglot manages it."
  (let ((file (expand-file-name name)))
    (let ((old (find-buffer-visiting file)))
      (when old
        (with-current-buffer old (set-buffer-modified-p nil))
        (kill-buffer old)))
    (with-temp-file file (apply #'insert lines))
    (find-file file)
    (cl-assert (eq major-mode 'sdlc-mode))
    (unless (eglot-managed-p)
      (if (eglot-current-server)
          (eglot--maybe-activate-editing-mode)
        (call-interactively #'eglot)))
    (core-until "eglot" #'eglot-managed-p)))

(defun core-goto (text)
  "Put point at the beginning of TEXT."
  (goto-char (point-min))
  (search-forward text)
  (goto-char (match-beginning 0)))

(defun core-diagnostics (count)
  "Wait for COUNT diagnostics."
  (core-until (format "%d diagnostics" count)
              (lambda ()
                (flymake-start)
                (and (= count (length (flymake-diagnostics))) (list (flymake-diagnostics)))))
  (flymake-diagnostics))

(defmacro core-check (name &rest body)
  "Run BODY; print NAME with its outcome."
  (declare (indent 1))
  `(condition-case problem
       (progn ,@body
              (cl-incf core-passed)
              (princ (format "ok    %s\n" ,name)))
     (error
      (cl-incf core-failed)
      (princ (format "FAIL  %s\n      %S\n" ,name problem)))))

(core-check "diagnostics"
  (core-open "a.scene" "scene 1\n" core-camera (string-replace "radius" "radus" core-ball))
  (let ((found (car (core-diagnostics 1))))
    (cl-assert (string-match-p "unknown property `radus`" (flymake-diagnostic-text found)))
    (cl-assert (equal "radus" (buffer-substring (flymake-diagnostic-beg found) (flymake-diagnostic-end found))))))

(core-check "fixes"
  (core-goto "radus")
  (cl-letf (((symbol-function 'completing-read)
             (lambda (_prompt collection &rest _) (cl-find "radius" (mapcar #'car collection) :test #'string-search))))
    ;; As if by a key: after a mouse click, Eglot opens a menu.
    (let ((last-nonmenu-event t)) (call-interactively #'eglot-code-actions)))
  (core-until "the fix" (lambda () (string-search "radius: 1" (buffer-string)))))

(core-check "completion"
  (core-open "complete.scene" "scene 1\n" core-camera "sphere { ra }\n")
  (goto-char (point-max))
  (search-backward " }")
  (cl-destructuring-bind (beginning end table &rest _) (eglot-completion-at-point)
    (let ((words (all-completions (buffer-substring beginning end) table)))
      (cl-assert (cl-find "radius" words :test #'string-search) nil "%S" words))))

(core-check "hover"
  (core-open "hover.scene" "scene 1\nlet a = 2 * pi\n")
  (core-goto "a =")
  (let (shown)
    (eglot-hover-eldoc-function (lambda (text &rest _) (setq shown text)))
    (core-until "a text" (lambda () shown))
    (cl-assert (string-search "6.283" shown) nil "%s" shown)))

(with-temp-file "library.scene" (insert "scene 1\nlet brass = specular(color: tan)\n"))
(defconst core-user "scene 1\nimport \"library.scene\" as l\nlet a = l.brass\nlet b = l.brass\n")

(core-check "definition"
  (core-open "user.scene" core-user)
  (core-goto "brass")
  (call-interactively #'xref-find-definitions)
  (cl-assert (equal "library.scene" (file-name-nondirectory (buffer-file-name))))
  (cl-assert (= 2 (line-number-at-pos))))

(core-check "references"
  (core-open "user.scene" core-user)
  (core-goto "brass")
  (cl-assert (= 3 (length (xref-backend-references 'eglot (xref-backend-identifier-at-point 'eglot))))))

(core-check "rename"
  (core-open "user.scene" core-user)
  (core-goto "brass")
  (cl-letf (((symbol-function 'y-or-n-p) #'always)) (eglot-rename "gold"))
  (core-until "the new name" (lambda () (string-search "let a = l.gold\nlet b = l.gold" (buffer-string))))
  (save-some-buffers t)
  (with-temp-buffer
    (insert-file-contents "library.scene")
    (cl-assert (string-search "let gold =" (buffer-string)))))

(core-check "formatting"
  (core-open "layout.scene" "scene 1\nlet  a=1\n")
  (call-interactively #'eglot-format-buffer)
  (cl-assert (equal "scene 1\nlet a = 1\n" (buffer-string))))

(core-check "symbols"
  (core-open "symbols.scene" "scene 1\n" core-camera "let size = 1\n" core-ball)
  (let ((index (format "%S" (funcall imenu-create-index-function))))
    (dolist (name '("main" "size" "ball"))
      (cl-assert (string-search name index) nil "%s" index))))

(core-check "indentation and comments of the mode"
  (core-open "mode.scene" "scene 1\nsphere {\nradius: 1\n}\n")
  (indent-region (point-min) (point-max))
  (cl-assert (equal "scene 1\nsphere {\n  radius: 1\n}\n" (buffer-string)))
  (core-goto "radius")
  (call-interactively #'comment-line)
  (cl-assert (string-search "  // radius: 1" (buffer-string))))

(let ((kill-emacs-query-functions nil))
  (eglot-shutdown (eglot-current-server))
  (princ (format "%d of %d checks passed\n" core-passed (+ core-passed core-failed)))
  (dolist (buffer (buffer-list)) (with-current-buffer buffer (set-buffer-modified-p nil)))
  (kill-emacs (if (> core-failed 0) 1 0)))
;;; core-test.el ends here
